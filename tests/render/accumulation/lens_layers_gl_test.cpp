// Tests data layers against the rendered image and against closed forms. Data layers are depth, normals and other
// surface data, averaged over lens samples.

#include <algorithm>
#include <cmath>
#include <limits>

#include "lens/circle_of_confusion.h"
#include "likeness.h"
#include "render/accumulation/drawn_layers.h"
#include "render/accumulation/lens_layers.h"

namespace defocus::engine {
namespace {

// Returns three unlit squares of different colours on black, at depths of 1, 2 and 5 m. The second square is in focus.
std::unique_ptr<SmallWorld> threeSquares() {
    auto small = std::make_unique<SmallWorld>();
    const glm::vec4 colours[] = {{1, 0.2f, 0, 1}, {0.1f, 0.9f, 0.3f, 1}, {0.2f, 0.3f, 2, 1}};
    for (int i = 0; i < 3; ++i) {
        small->scene.materials.push_back(unlitMaterial(colours[i]));
        small->scene.materials.back().name = "Colour " + std::to_string(i);
        small->scene.meshes.push_back(quad(i));
    }
    place(*small, 0, facing(-0.15, 0, 1, 0.15));
    place(*small, 1, facing(0, 0.1, 2, 0.35));
    place(*small, 2, facing(0.3, 0, 5, 1.1));
    small->world.environment = {EnvironmentType::uniform, glm::vec3(0), {}, {}, nullptr, 1};
    small->view.width = 96;
    small->view.height = 64;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    finish(*small);
    return small;
}

// The sums of data layers take the predicted memory, plus 4 bytes per pixel for an unused attachment.
TEST_F(LensLayer, takeTheMemoryThatIsPredicted) {
    for (const bool countsSamples : {false, true})
        for (const std::vector<Layer>& layers :
             {everyLayer, {Layer::normal}, {Layer::depth}, {Layer::objects}, {Layer::coc, Layer::materials}}) {
            const LensLayers sums(layers, countsSamples, {8, 4}, {});
            EXPECT_EQ(sums.bytes(), 8 * 4 * (LensLayers::sumBytes(layers, countsSamples) + 4)) << layers.size();
        }
    EXPECT_EQ(LensLayers::layerBytes({Layer::normal}, true),
              LensLayers::layerBytes({Layer::normal, Layer::depth}, false));
}

TEST_F(LensLayer, leavesThePictureUnchanged) {
    const auto small = fiveSpheres();
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const Image plain = rendered(*small, settingsFor(24, LodMode::off), options);
    EXPECT_LT(largestDifference(plain, drawn(*small, 24).picture), 1e-5);
}

// For unlit objects, the sum over all objects of mask × colour equals the rendered image. A mask is the fraction of a
// pixel's samples that show an object.
TEST_F(LensLayer, masksTimesObjectsAreThePicture) {
    const auto small = threeSquares();
    for (const double catEye : {0.0, 0.5}) {
        SCOPED_TRACE(catEye);
        small->view.lens.catEye = catEye;
        const Drawn frame = drawn(*small, 96, {Layer::objects, Layer::materials});
        for (const Layer layer : {Layer::objects, Layer::materials}) {
            const NumberCounts& counts = frame.layers.numbers.at(layer);
            Image sum(frame.picture.width, frame.picture.height, 4);
            for (std::size_t pixel = 0; pixel < sum.pixels.size() / 4; ++pixel)
                for (std::size_t e = 0; e < static_cast<std::size_t>(counts.entries); ++e) {
                    const std::uint32_t entry = counts.values[pixel * static_cast<std::size_t>(counts.entries) + e];
                    if (entry == 0) break;
                    const Material& material = small->scene.materials[(entry >> 16) - 1];
                    const float mask = static_cast<float>(entry & 0xffffu) / frame.layers.samples.pixels[pixel];
                    for (glm::length_t c = 0; c < 3; ++c)
                        sum.pixels[4 * pixel + static_cast<std::size_t>(c)] += mask * material.baseColorFactor[c];
                }
            for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
                if (i % 4 != 3) {
                    ASSERT_NEAR(sum.pixels[i], frame.picture.pixels[i], 1e-3) << i;
                }
            }
        }
    }
}

// For unlit surfaces, the albedo layer and the emission layer equal the rendered image.
TEST_F(LensLayer, albedoIsFilteredAsThePicture) {
    const Drawn frame = drawn(*threeSquares(), 64);
    for (const Layer layer : {Layer::albedo, Layer::emission}) {
        const Image& image = frame.layers.means.at(layer);
        const double tolerance = layer == Layer::albedo ? 2e-3 : 1e-5;  // albedo layers are half floats
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_NEAR(image.pixels[i], frame.picture.pixels[i / 3 * 4 + i % 3], tolerance) << i;
    }
}

TEST_F(LensLayer, coverageIsTheAlphaOfATransparentPicture) {
    const auto small = threeSquares();
    small->world.environment.visible = false;
    using enum Layer;
    const std::vector<std::vector<Layer>> choices = {everyLayer,        {depth},         {depth, normal},
                                                     {depth, position}, {depth, albedo}, {coc, motion},
                                                     {albedo, normal},  {normal},        {objects}};
    for (const std::vector<Layer>& layers : choices) {
        const Drawn frame = drawn(*small, 64, layers);
        for (std::size_t i = 0; i < frame.layers.coverage.pixels.size(); ++i)
            ASSERT_NEAR(frame.layers.coverage.pixels[i], frame.picture.pixels[4 * i + 3], 1e-5) << layers.size();
    }
}

TEST_F(LensLayer, ofAWallAreItsPlaceAndBlur) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({0.5f, 0.25f, 0.125f, 1}));
    small->scene.meshes.push_back(quad(0));
    place(*small, 0, facing(0, 0, 3, 10));
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.fStop = 0.8;
    small->view.lens.focusDistance = 2;
    small->view.worldFromCamera = glm::translate(glm::dmat4(1), glm::dvec3(0.25, -0.5, 0));
    finish(*small);
    const Drawn frame = drawn(*small, 64);
    const double coc = circleOfConfusion(frame.plan.coc, 3, small->view.width);
    EXPECT_GT(coc, 0.5);
    const double tanX = tanHalfHorizontalFov(small->view.lens);
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(20, 31), glm::ivec2(63, 47)}) {
        const auto at = [&](Layer layer, int c = 0) {
            return valueAt(frame.layers.means.at(layer), pixel.x, pixel.y, c);
        };
        EXPECT_NEAR(valueAt(frame.layers.coverage, pixel.x, pixel.y), 1, 1e-6);
        EXPECT_NEAR(at(Layer::depth), 3, 1e-5);
        EXPECT_NEAR(valueAt(frame.layers.nearestDepth, pixel.x, pixel.y), 3, 1e-5);
        EXPECT_NEAR(at(Layer::coc), coc, 1e-3);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(Layer::normal, c), c == 2 ? 1 : 0, 1e-3);
        EXPECT_NEAR(at(Layer::albedo, 1), 0.25, 1e-3);
        const double pixelWidth = 2 * tanX * 3 / small->view.width;
        // The mean position of a pixel's samples deviates from the pixel's centre by up to a tenth of the blur.
        const double tolerance = (0.1 * coc + 0.1) * pixelWidth;
        EXPECT_NEAR(at(Layer::position, 0), 0.25 + (pixel.x + 0.5 - 32) * pixelWidth, tolerance);
        EXPECT_NEAR(at(Layer::position, 1), -0.5 + (24 - pixel.y - 0.5) * pixelWidth, tolerance);
        EXPECT_NEAR(at(Layer::position, 2), -3, 1e-5);
        EXPECT_EQ(at(Layer::motion), 0);
        EXPECT_EQ(frame.layers.numbers.at(Layer::objects).values[0], (1u << 16) + 64);
    }
}

// In pixels without a surface, all layers are 0, except the nearest depth, which is infinite.
TEST_F(LensLayer, ofNothingAreEmpty) {
    const auto small = threeSquares();
    small->world.pose.objects.resize(1);
    const Drawn frame = drawn(*small, 16);
    EXPECT_EQ(valueAt(frame.layers.coverage, 95, 0), 0);
    EXPECT_EQ(valueAt(frame.layers.nearestDepth, 95, 0), std::numeric_limits<float>::infinity());
    for (const auto& [layer, image] : frame.layers.means)
        EXPECT_EQ(valueAt(image, 95, 0), 0) << static_cast<int>(layer);
    EXPECT_EQ(frame.layers.numbers.at(Layer::objects).values[95 * 16], 0u);
}

// Data layers weight surfaces by alpha: a pane with alpha 1/4 in front of a wall has the weight 1/4, and the wall has
// 3/4.
TEST_F(LensLayer, ofBlendedSurfacesFollowAlpha) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({1, 0, 0, 0.25f}), unlitMaterial({0, 1, 0, 1})};
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.meshes = {quad(0), quad(1)};
    place(*small, 0, facing(0, 0, 1, 5));
    place(*small, 1, facing(0, 0, 4, 20));
    small->view.width = 32;
    small->view.height = 24;
    small->view.lens.focusDistance = 2;
    finish(*small);
    const Drawn frame = drawn(*small, 64);
    EXPECT_NEAR(valueAt(frame.layers.means.at(Layer::albedo), 16, 12, 0), 0.25, 2e-3);
    EXPECT_NEAR(valueAt(frame.layers.means.at(Layer::albedo), 16, 12, 1), 0.75, 2e-3);
    EXPECT_NEAR(valueAt(frame.layers.means.at(Layer::depth), 16, 12), 0.25 * 1 + 0.75 * 4, 0.05);
    EXPECT_NEAR(valueAt(frame.layers.coverage, 16, 12), 1, 1e-5);
    const NumberCounts& counts = frame.layers.numbers.at(Layer::objects);
    std::map<std::uint32_t, std::uint32_t> count;
    for (std::size_t e = 0; e < 2; ++e) {
        const std::uint32_t entry = counts.values[(12 * 32 + 16) * static_cast<std::size_t>(counts.entries) + e];
        count[entry >> 16] = entry & 0xffffu;
    }
    const auto samples = static_cast<std::uint32_t>(frame.plan.samples.size());
    EXPECT_NEAR(count[1], 0.25 * samples, 2);
    EXPECT_EQ(count[1] + count[2], samples);
}

// The motion of a square at depth z that moves by d along x is d·W/(2·z·tan(θx/2)) px, with the image width W and the
// horizontal field of view θx.
TEST_F(LensLayer, motionIsTheWayDuringTheExposure) {
    const auto small = threeSquares();
    small->world.pose.objects.resize(1);
    small->world.pose.objects[0].worldFromObject = facing(0, 0, 2, 1);
    small->world.shutter.poses.assign(2, small->world.pose);
    small->world.shutter.poses[0].objects[0].worldFromObject = facing(-0.05, 0.02, 2, 1);
    small->world.shutter.poses[1].objects[0].worldFromObject = facing(0.05, -0.02, 2, 1);
    const Drawn frame = drawn(*small, 32, {Layer::motion});
    const double pixels = small->view.width / (2 * 2 * tanHalfHorizontalFov(small->view.lens));
    EXPECT_NEAR(valueAt(frame.layers.means.at(Layer::motion), 48, 32, 0), 0.1 * pixels, 1e-3);
    EXPECT_NEAR(valueAt(frame.layers.means.at(Layer::motion), 48, 32, 1), -0.04 * pixels, 1e-3);
}

// Data layers depend neither on the number of samples that are drawn together nor on the choice of other data layers.
TEST_F(LensLayer, dependOnlyOnTheSamples) {
    const auto small = fiveCoarseSpheres();
    const Drawn all = drawn(*small, 70);
    const Drawn single = drawn(*small, 70, everyLayer, 1);
    for (const auto& [layer, image] : all.layers.means)
        EXPECT_TRUE(sameBits(image, single.layers.means.at(layer))) << static_cast<int>(layer);
    const Drawn alone = drawn(*small, 70, {Layer::normal});
    EXPECT_LT(largestDifference(all.layers.means.at(Layer::normal), alone.layers.means.at(Layer::normal)), 1e-5);
    EXPECT_EQ(all.layers.numbers.at(Layer::objects).values, single.layers.numbers.at(Layer::objects).values);
}

}  // namespace
}  // namespace defocus::engine
