// Tests Scheuermann's gather blur: taps in the shape of the aperture, 8-bit storage as published, and blur planes set
// by hand.

#include <gtest/gtest.h>

#include <set>

#include "aperture_shapes.h"
#include "bokeh.h"
#include "core/error.h"
#include "gl_context_test.h"
#include "image/tone_map.h"
#include "render/methods.h"
#include "render/post_process/boards.h"
#include "render/rendered.h"
#include "render/scheuermann/scheuermann.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using ScheuermannImage = GlContextTest;

constexpr double lightSide = 6;  // side of the bright square, px
constexpr double lightEnergy = 360;

Image rendered(const World& world, const View& view, const char* method) {
    const MethodUse use = parseMethodUse(method);
    const RendererOptions options{.settings = use.settings};
    const auto renderer = use.method->make(world, options);
    const RenderSettings settings{.lod = LodMode::off};
    return imageOf(*renderer, planFrame(world, view, settings));
}

// Returns the bokeh of a bright square that is surrounded by a black wall at the same depth, so that all pixels have
// the same blur.
Image bokehOf(const View& view, double depth,
              const char* method = "scheuermann:coc=thin-lens,taps=64,max-coc=unlimited") {
    const double left = (view.width - lightSide) / 2;
    const double top = (view.height - lightSide) / 2;
    const double right = left + lightSide;
    const double bottom = top + lightSide;
    const double far = 4 * view.width;
    Scene scene = rectangleScene(view,
                                 {{left, top, right, bottom, depth},
                                  {-far, -far, left, far, depth},
                                  {right, -far, far, far, depth},
                                  {left, -far, right, top, depth},
                                  {left, bottom, right, far, depth}},
                                 glm::vec3(static_cast<float>(lightEnergy / (lightSide * lightSide))));
    scene.materials.push_back(scene.materials.front());
    scene.materials.back().baseColorFactor = glm::vec4(0, 0, 0, 1);
    for (std::size_t i = 1; i < scene.meshes.size(); ++i) scene.meshes[i].primitives.front().material = 1;
    World world = flatWorld(scene, blackBackground());
    for (const Mesh& mesh : scene.meshes) world.pyramids.push_back(fullDetail(mesh));
    return rendered(world, view, method);
}

// A blurred bright square has the shape of the aperture, upright behind the focal plane and rotated by 180° in front of
// it. The 64 taps form dots of a few pixels, so no smooth shape fits exactly. Far less light lies outside the expected
// shape than outside the same shape rotated by 180°.
TEST_F(ScheuermannImage, showsTheShapeOfTheApertureUprightBehindTheFocusAndTurnedInFrontOfIt) {
    std::vector<std::pair<std::string, Lens>> lenses;
    const View view = bokehView(192, 144);
    for (const ApertureShape& shape : apertureShapes)
        if (shape.blades == 3 && shape.curvature == 0) lenses.emplace_back(shape.name, shape.lens(view.lens));
    lenses.emplace_back("image", view.lens);
    lenses.back().second.apertureImage = std::make_shared<const Image>(lopsidedImage());
    for (const auto& [name, lens] : lenses)
        for (const double depth : {6.0, 1.2}) {
            View shaped = view;
            shaped.lens = lens;
            const Image image = bokehOf(shaped, depth);
            const auto light = lightOf(lens);
            const auto turned = [&](const glm::dvec2& p) { return light(-p); };
            const Image upright = expectedBokeh(shaped, depth, lightSide, lightEnergy, light);
            const Image reversed = expectedBokeh(shaped, depth, lightSide, lightEnergy, turned);
            EXPECT_NEAR(momentsOf(image).energy, lightEnergy, 0.03 * lightEnergy) << name << depth;
            const double asBehind = misplacedLight(image, upright);
            const double asInFront = misplacedLight(image, reversed);
            EXPECT_LT(depth > 2 ? asBehind : asInFront, 0.6 * (depth > 2 ? asInFront : asBehind)) << name << depth;
        }
}

TEST_F(ScheuermannImage, ofARingIsDarkInTheMiddle) {
    View view = bokehView(192, 144);
    const auto middle = [&] { return *bokehOf(view, 6).at(view.width / 2, view.height / 2); };
    const double ofADisk = middle();
    view.lens.obstruction = 0.7;
    EXPECT_LT(middle(), 0.1 * ofADisk);
}

// With 8-bit encoded colours, an image in focus equals the pinhole image, clamped at white and rounded, except for
// a small fraction of the pre-blurred image. This fraction is mixed in because a byte cannot represent zero blur.
TEST_F(ScheuermannImage, inBytesRoundsEncodedColours) {
    const auto small = fiveSpheres();
    small->view.lens.blurScale = 0;
    const Image bytes = rendered(small->world, small->view, "scheuermann:bits=8,pinholes=1");
    const Image floats = rendered(small->world, small->view, "scheuermann:pinholes=1");
    double squared = 0;
    for (std::size_t i = 0; i < floats.pixels.size(); ++i) {
        const float value = bytes.pixels[i];
        EXPECT_LE(value, 1.001f);
        squared += std::pow(double(srgbEncode(value)) - double(srgbEncode(floats.pixels[i])), 2);
    }
    const double error = std::sqrt(squared / static_cast<double>(floats.pixels.size()));
    EXPECT_LT(error, 1.0 / 255);
    // lower bound: half the RMS error of rounding to 8 bits, since alpha, which has no error, lowers the mean
    EXPECT_GT(error, 0.5 / 255 / std::sqrt(12.0));
}

// At max blur, the published method reads only the low-resolution image, whose pixels are 4 px wide. The taps lie in a
// disk of 0.4 · 4 = 1.6 times the blur's radius, with the published factor 0.4. The variance of a blurred square is the
// sum of the variances of the square, the taps and the low-resolution image. The low-resolution image adds 16/12 px²
// for its pixels' width, 16/6 px² for linear interpolation and 8 px² for the Gaussian pre-blur.
TEST_F(ScheuermannImage, asPublishedReadsTheSmallImageAtItsOwnRadius) {
    View view = bokehView(192, 144);
    const Image image = bokehOf(view, 6, "scheuermann:far-blur-depth=5,blurriness-cutoff=1");
    const double radius = 1.6 * 5;  // 1.6 times the radius of the max blur, which is 10 px wide
    glm::dvec2 mean(0);
    glm::dvec2 meanSquare(0);
    const std::vector<glm::vec2> taps = poissonDisk(8);
    for (const glm::vec2& tap : taps) {
        mean += glm::dvec2(tap) / 8.0;
        meanSquare += glm::dvec2(tap) * glm::dvec2(tap) / 8.0;
    }
    const glm::dvec2 ofTheTaps = radius * radius * (meanSquare - mean * mean);
    const Moments moments = momentsOf(image);
    const double ofTheLight = (lightSide * lightSide - 1) / 12;
    for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(moments.variance[axis], ofTheTaps[axis] + 12 + ofTheLight, 0.03 * ofTheTaps[axis]) << axis;
}

// With four samples per pixel, the display-encoded pixels of an edge in focus are multiples of a quarter of white,
// because the samples are averaged after encoding.
TEST_F(ScheuermannImage, multisamplingSmoothsEdgesBeforeTheBlur) {
    const auto small = boards({{2, {-1, 0}, {1, 2}, {1, 1, 1, 1}}}, glm::vec3(0));
    small->view.worldFromCamera = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 0, 1));
    small->view.lens.blurScale = 0;
    const auto greys = [&](const char* method) {
        std::set<int> found;  // grey levels in the image, in units of white / 4
        const Image image = postProcessed(*small, method);
        for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
            const float quarters = 4 * srgbEncode(image.pixels[i]);
            // The tolerance allows for bits=8: a byte cannot represent a blur of zero, and the smallest blur moves taps
            // up to 0.02 px away from the pixel's centre.
            EXPECT_NEAR(quarters, std::round(quarters), 0.1);
            found.insert(static_cast<int>(std::round(quarters)));
        }
        return found;
    };
    EXPECT_EQ(greys("scheuermann:bits=8,pinholes=1"), (std::set{0, 4}));
    EXPECT_EQ(greys("scheuermann:bits=8,pinholes=1,multisampling=4"), (std::set{0, 1, 2, 3, 4}));
}

TEST_F(ScheuermannImage, planesByHandMustBeInOrder) {
    const auto small = fiveSpheres();
    EXPECT_NO_THROW(rendered(small->world, small->view, "scheuermann:near-blur-depth=0.1,far-blur-depth=1e6"));
    EXPECT_THROW(rendered(small->world, small->view, "scheuermann:near-blur-depth=1000"), Error);
    EXPECT_THROW(rendered(small->world, small->view, "scheuermann:focal-plane-depth=5,far-blur-depth=4"), Error);
    EXPECT_THROW(rendered(small->world, small->view, "scheuermann:coc=thin-lens,far-blur-depth=9"), Error);
}

}  // namespace
}  // namespace defocus::engine
