// Tests each aperture's bokeh against an image that is computed from the aperture's definition without the renderer.

#include <gtest/gtest.h>

#include "aperture_shapes.h"
#include "bokeh.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"

namespace defocus::engine {
namespace {

class ApertureBokeh : public GlContextTest {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

constexpr double square = 5;  // side of the bright square, px
constexpr double energy = 2500;
constexpr double depth = 6;  // depth of the square, m; behind the focal plane, bokeh shows the aperture upright

// Returns a view whose lens blurs the square to about two thirds of the image's height.
View wideView() {
    View view = bokehView(96, 72);
    view.lens.fStop = 0.05;
    return view;
}

Image bokehOf(const View& view) {
    const double left = (view.width - square) / 2;
    const double top = (view.height - square) / 2;
    const Scene scene = rectangleScene(view, {{left, top, left + square, top + square, depth}},
                                       glm::vec3(static_cast<float>(energy / (square * square))));
    World world = flatWorld(scene, blackBackground());
    world.pyramids.push_back(fullDetail(scene.meshes.front()));
    const RenderSettings settings{.sampleCount = 1024, .lod = LodMode::off};
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const auto renderer = makeAccumulationRenderer(world, options);
    return imageOf(*renderer, planFrame(world, view, settings));
}

void expectBokeh(const View& view, const std::string& name) {
    const Image image = bokehOf(view);
    const Image expected = expectedBokeh(view, depth, square, energy, lightOf(view.lens));
    const Moments found = momentsOf(image);
    const Moments wanted = momentsOf(expected);
    EXPECT_NEAR(found.energy, energy, 0.005 * energy) << name;
    EXPECT_NEAR(found.mean.x, wanted.mean.x, 0.1) << name;
    EXPECT_NEAR(found.mean.y, wanted.mean.y, 0.1) << name;
    EXPECT_NEAR(std::sqrt(found.variance.x), std::sqrt(wanted.variance.x), 0.05) << name;
    EXPECT_NEAR(std::sqrt(found.variance.y), std::sqrt(wanted.variance.y), 0.05) << name;
    EXPECT_LT(misplacedLight(image, expected), 0.04) << name;
}

TEST_F(ApertureBokeh, hasTheShapeAndTheEnergyOfItsDefinition) {
    for (const ApertureShape& shape : apertureShapes) {
        View view = wideView();
        view.lens = shape.lens(view.lens);
        expectBokeh(view, shape.name);
    }
}

TEST_F(ApertureBokeh, showsTheApertureImageUpright) {
    View view = wideView();
    view.lens.apertureImage = std::make_shared<const Image>(lopsidedImage());
    expectBokeh(view, "image");
}

// The limit on misplaced light detects wrong shapes: a triangle that is rotated, curved or unevenly bright exceeds the
// limit.
TEST_F(ApertureBokeh, differsFromOtherShapes) {
    View view = wideView();
    view.lens.bladeCount = 3;
    const Image triangle = bokehOf(view);
    View other = view;
    other.lens.bladeRotation = 0.3;
    EXPECT_GT(misplacedLight(triangle, expectedBokeh(other, depth, square, energy, lightOf(other.lens))), 0.06);
    other = view;
    other.lens.bladeCurvature = 0.5;
    EXPECT_GT(misplacedLight(triangle, expectedBokeh(other, depth, square, energy, lightOf(other.lens))), 0.06);
    other = view;
    other.lens.sphericalAberration = 0.6;
    EXPECT_GT(misplacedLight(triangle, expectedBokeh(other, depth, square, energy, lightOf(other.lens))), 0.06);
}

}  // namespace
}  // namespace defocus::engine
