#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bokeh.h"
#include "gl/context.h"
#include "image/metrics.h"
#include "likeness.h"
#include "lod/pyramid/pyramid.h"
#include "plan/lens_cells/rates.h"
#include "plan/sample_range.h"
#include "render/methods.h"
#include "render/multirate/partly_shared.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Multirate : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<GlContext> context_;
};
std::unique_ptr<GlContext> Multirate::context_;

// With every rate 1, multirate draws the accumulation's bits.
TEST_F(Multirate, keepingEverythingGivesTheBitsOfAccumulation) {
    const auto small = partlyShared();
    for (const LodMode lod : {LodMode::fractional, LodMode::continuous, LodMode::off}) {
        RenderSettings settings = ratedSettings(100, lod);
        ASSERT_GT(sharingObjects(*small, settings), 0u);
        settings.keepAll = true;
        for (const char* method : {sharing, "multirate"})
            EXPECT_TRUE(sameBits(drawnBy("accumulation", *small, settings), drawnBy(method, *small, settings)));
    }
}

TEST_F(Multirate, waveSizeChangesNoBit) {
    const auto small = partlyShared();
    ASSERT_GT(sharingObjects(*small, ratedSettings(64, LodMode::continuous)), 0u);
    for (const LayerFormat format : {LayerFormat::rgba16f, LayerFormat::rgba32f})
        for (const std::uint32_t samples : {64u, 200u}) {
            Image first;
            for (const std::uint32_t k : {1u, 3u, 64u}) {
                RendererOptions options;
                options.wave = k;
                options.layerFormat = format;
                const Image image = drawnBy(sharing, *small, ratedSettings(samples, LodMode::continuous), options);
                if (first.empty()) first = image;
                EXPECT_TRUE(sameBits(first, image)) << "K = " << k << ": " << largestDifference(first, image);
            }
        }
}

// A geometry shader selects layers on GPUs that cannot select them in the vertex shader.
TEST_F(Multirate, geometryShaderLayersGiveTheSameImage) {
    const auto small = partlyShared();
    RendererOptions options;
    options.geometryShaderLayers = true;
    const RenderSettings settings = ratedSettings(64);
    EXPECT_LT(largestDifference(drawnBy(sharing, *small, settings), drawnBy(sharing, *small, settings, options)), 1e-3);
}

// Blocks that are added later, or that other machines draw, add up to the complete frame.
TEST_F(Multirate, blocksAreThoseOfTheWholeFrame) {
    const auto small = partlyShared();
    const FramePlan plan = planFrame(small->world, small->view, ratedSettings(192, LodMode::fractional));
    const auto full = rendererOf(sharing, small->world);
    const auto part = rendererOf(sharing, small->world);
    full->start(plan);
    part->start(samplesOf(plan, 0, 64));
    while (part->advance()) {
    }
    for (const std::uint32_t first : {64u, 128u}) {
        part->continueWith(samplesOf(plan, first, 64));
        while (part->advance()) {
        }
    }
    while (full->advance()) {
    }
    EXPECT_TRUE(sameBits(full->image(), part->image()));
    EXPECT_EQ(full->stats().trianglesDrawn, ratedTriangles(plan, frameRates(plan, false)));
    EXPECT_EQ(part->stats().trianglesDrawn, ratedTriangles(plan, frameRates(plan, false)));
}

TEST_F(Multirate, apertureZeroIsThePinhole) {
    const auto small = partlyShared();
    RenderSettings settings = ratedSettings(64);
    small->view.lens.dofEnabled = false;
    const Image pinhole = drawnBy(sharing, *small, settings);
    EXPECT_TRUE(sameBits(pinhole, drawnBy("accumulation", *small, settings)));
    small->view.lens.dofEnabled = true;
    small->view.lens.blurScale = 0;
    EXPECT_TRUE(sameBits(pinhole, drawnBy(sharing, *small, settings)));
}

// A wall that fills the frame appears once in each sample, however much is shared.
TEST_F(Multirate, constantSceneStaysConstant) {
    SmallWorld small;
    small.scene.materials.push_back(unlitMaterial({0.1f, 0.7f, 1.0f / 3, 1}));
    small.scene.meshes.push_back(quad(0));
    place(small, 0, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2.05)), glm::dvec3(9)));
    small.view.width = 96;
    small.view.height = 64;
    small.view.lens.fStop = 1;
    small.view.lens.focusDistance = 2;
    finish(small);
    RendererOptions exact;
    exact.layerFormat = LayerFormat::rgba32f;
    for (const std::uint32_t n : {1u, 7u, 32u, 64u, 65u, 200u}) {
        ASSERT_EQ(sharingObjects(small, ratedSettings(n)), 1u);
        const Image image = drawnBy(sharing, small, ratedSettings(n), exact);
        EXPECT_LT(relativeDifferenceFrom(image, {0.1f, 0.7f, 1.0f / 3}), 1e-6) << n;
    }
}

// Bright, tilted pickets at 2 m, and behind them a dark wall that ends within the frame.
std::unique_ptr<SmallWorld> fenceAndWall(double wallDepth, double focus, double fStop) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({0.9f, 0.8f, 0.3f, 1}));
    small->scene.materials.push_back(unlitMaterial({0.05f, 0.2f, 0.5f, 1}));
    small->scene.meshes.push_back(quad(0));
    small->scene.meshes.push_back(quad(1));
    const auto at = [](double x, double y, double depth) {
        return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(x, y, -depth)), 0.2, glm::dvec3(0, 0, 1));
    };
    for (int i = 0; i < 12; ++i) place(*small, 0, glm::scale(at((i - 5.5) * 0.12, 0, 2), glm::dvec3(0.03, 9, 1)));
    place(*small, 1, glm::scale(at(0.4, 0.3, wallDepth), glm::dvec3(0.9, 0.9, 1)));
    small->world.environment = {EnvironmentType::uniform, {0.3f, 0.1f, 0.1f}, {}, {}, nullptr, 1};
    small->view.width = 160;
    small->view.height = 96;
    small->view.lens.fStop = fStop;
    small->view.lens.focusDistance = focus;
    finish(*small);
    return small;
}

// If every object is shared by four samples, the image is the accumulation's with a quarter of the samples.
TEST_F(Multirate, whatAllShareIsTheAccumulationOfAQuarterOfTheSamples) {
    const auto small = fenceAndWall(2.4, 2.2, 0.6);
    for (const ObjectPlan& object : planFrame(small->world, small->view, ratedSettings(64)).objects)
        ASSERT_TRUE(object.coc.largest > 0.5 && object.coc.largest < wholeShareBlur) << object.coc.largest;
    RendererOptions exact;
    exact.layerFormat = LayerFormat::rgba32f;
    for (const std::uint32_t n : {64u, 256u}) {
        const Image quarter = drawnBy("accumulation", *small, ratedSettings(n / 4), exact);
        EXPECT_LT(largestDifference(quarter, drawnBy(sharing, *small, ratedSettings(n), exact)), 1e-5) << n;
    }
}

// Multirate converges as the accumulation does. By the sequence's exponent, N^−0.65, a quarter of the samples err 2.5
// times as much. The exponent of a shared object may differ.
TEST_F(Multirate, convergesToTheReference) {
    const auto small = fenceAndWall(3, 2.02, 0.15);
    ASSERT_EQ(sharingObjects(*small, ratedSettings(64)), 12u);
    const Image reference = convergedImage(*small);
    std::vector<double> errors;
    for (const std::uint32_t n : {64u, 256u, 1024u}) {
        errors.push_back(compareImages(reference, drawnBy(sharing, *small, ratedSettings(n))).rmse);
        const double alone = compareImages(reference, drawnBy("accumulation", *small, ratedSettings(n))).rmse;
        EXPECT_LT(errors.back(), 3 * alone) << n;
    }
    EXPECT_GT(std::log(errors.front() / errors.back()) / std::log(16.0), 0.5)
        << errors[0] << ' ' << errors[1] << ' ' << errors[2];
}

// A shared object and an unshared one show no halo around each other. No pixel exceeds the accumulation's error by more
// than 2/255.
TEST_F(Multirate, aSharpFenceBeforeABlurredWallAndABlurredOneBeforeASharpWallHaveNoHalo) {
    for (const bool sharpInFront : {true, false}) {
        const auto small = fenceAndWall(3, sharpInFront ? 2.02 : 2.98, 0.15);
        ASSERT_EQ(sharingObjects(*small, ratedSettings(64)), sharpInFront ? 12u : 1u);
        for (const ObjectPlan& object : planFrame(small->world, small->view, ratedSettings(64)).objects)
            ASSERT_TRUE(object.coc.largest < 1 || object.coc.largest > 2 * minShareBlur);
        const Image reference = convergedImage(*small);
        const auto worst = [&](const char* method) {
            return compareImages(reference, drawnBy(method, *small, ratedSettings(1024))).maxError;
        };
        EXPECT_LT(worst(sharing), worst("accumulation") + 2.0 / 255) << sharpInFront;
    }
}

// Two panels of one colour touch at an edge before a wall of another colour; only one of them is blurred enough to be
// shared. No line of the wall shows between them, at any level of detail and any position of the edge.
TEST_F(Multirate, panelsThatTouchShowNoLineBetweenThem) {
    for (const double across : {0.0, 0.0031}) {
        SmallWorld small;
        small.scene.materials.push_back(unlitMaterial({0.5f, 0.5f, 0.5f, 1}));
        small.scene.materials.push_back(unlitMaterial({1, 0, 0, 1}));
        small.scene.meshes.push_back(quad(0));
        small.scene.meshes.push_back(quad(1));
        // One panel slants away from the common edge, so that most of it is far more blurred.
        const glm::dmat4 edge = glm::translate(glm::dmat4(1), glm::dvec3(across, 0, -2.2));
        const glm::dmat4 panel =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-0.4, 0, 0)), glm::dvec3(0.4, 0.3, 1));
        const glm::dmat4 mirrored =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.4, 0, 0)), glm::dvec3(0.4, 0.3, 1));
        place(small, 0, edge * panel);
        place(small, 0, edge * glm::rotate(glm::dmat4(1), 1.2, glm::dvec3(0, 1, 0)) * mirrored);
        place(small, 1, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -9)), glm::dvec3(30)));
        small.view.width = 160;
        small.view.height = 96;
        small.view.lens.fStop = 0.25;
        small.view.lens.focusDistance = 2.1;
        finish(small);
        RendererOptions exact;
        exact.layerFormat = LayerFormat::rgba32f;
        const FramePlan plan = planFrame(small.world, small.view, ratedSettings(64));
        std::size_t couldShare = 0;
        for (const ObjectPlan& object : plan.objects) couldShare += object.coc.largest < wholeShareBlur ? 1 : 0;
        ASSERT_EQ(couldShare, 1u);
        // The pixels near the common edge, away from the panels' other edges.
        const auto worst = [&](const char* method) {
            const Image image = drawnBy(method, small, ratedSettings(64), exact);
            double largest = 0;
            for (int y = 36; y < 60; ++y)
                for (int x = 70; x < 90; ++x)
                    for (int c = 0; c < 3; ++c) largest = std::max<double>(largest, std::abs(image.at(x, y)[c] - 0.5));
            return largest;
        };
        EXPECT_LT(worst("accumulation"), 1.0 / 255);
        EXPECT_LT(worst(sharing), worst("accumulation") + 2.0 / 255);
    }
}

// A bright, slightly blurred square, fully shared, keeps its energy and its second moment.
TEST_F(Multirate, aBlurredLightKeepsItsEnergyAndItsSpread) {
    View view = bokehView(64, 64);
    view.lens.fStop = 0.35;
    const double depth = 3.5;
    const double c = blurDiameter(view, depth);
    ASSERT_LT(c, wholeShareBlur);
    ASSERT_GT(c, 2);
    const double side = 9;
    const Scene scene =
        rectangleScene(view, {{32 - side / 2, 32 - side / 2, 32 + side / 2, 32 + side / 2, depth}}, {8, 8, 8});
    World world = flatWorld(scene, blackBackground());
    world.pyramids = buildPyramids(scene.meshes);
    RendererOptions exact;
    exact.layerFormat = LayerFormat::rgba32f;
    const FramePlan plan = planFrame(world, view, ratedSettings(64));
    ASSERT_EQ(frameRates(plan, false).objects[0].lensShare, 1);
    const Image image = imageOf(*rendererOf(sharing, world, exact), plan);
    double energy = 0;
    double second = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double value = image.at(x, y)[0];
            energy += value;
            second += value * (std::pow(x + 0.5 - 32, 2) + std::pow(y + 0.5 - 32, 2));
        }
    EXPECT_NEAR(energy, 8 * side * side, 0.005 * 8 * side * side);
    // Sum over both axes: a disk has the variance c²/16 along each, a square side²/12, and a pixel 1/12.
    const double expected = 2 * (c * c / 16 + side * side / 12 + 1.0 / 12);
    EXPECT_NEAR(std::sqrt(second / energy), std::sqrt(expected), 0.1);
}

}  // namespace
}  // namespace defocus::engine
