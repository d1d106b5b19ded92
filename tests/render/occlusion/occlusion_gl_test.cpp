// Tests that occlusion culling on software rasterizers leaves every bit of the image unchanged.

#include <gtest/gtest.h>

#include "gl/context.h"
#include "gl_context_test.h"
#include "models.h"
#include "posed_world.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class OccludedSurfaces : public GlContextTest {
protected:
    void SetUp() override {
        if (!currentIsSoftware()) GTEST_SKIP() << "a GPU draws everything";
    }
};

struct OpaqueDrawn {
    Image image;
    double hidden = 0;  // fraction of the triangles that is culled
};

RenderSettings sharpLevels(std::uint32_t samples) {
    return {.sampleCount = samples, .lod = LodMode::off};
}

OpaqueDrawn opaqueDrawn(const char* method, const SmallWorld& small, const RenderSettings& settings,
                        std::uint32_t wave = 0, std::uint32_t threads = 1) {
    const RendererOptions options{.wave = wave, .threads = threads};
    const auto renderer = methodNamed(method).make(small.world, options);
    const FramePlan plan = planFrame(small.world, small.view, settings);
    drawAllSamples(*renderer, plan);
    const RenderStats stats = renderer->stats();
    return {renderer->image(), static_cast<double>(stats.trianglesHidden) / static_cast<double>(stats.trianglesDrawn)};
}

Image drawnWithAllHidden(const SmallWorld& small, RenderSettings settings) {
    settings.keepAll = true;
    const OpaqueDrawn drawn = opaqueDrawn("accumulation", small, settings);
    EXPECT_EQ(drawn.hidden, 0);
    return drawn.image;
}

// Returns a wall with a gap, and spheres in front of and behind the wall. The wall hides most of the spheres behind it.
std::unique_ptr<SmallWorld> behindAWall() {
    auto small = fiveSpheres();
    small->scene.materials.push_back(unlitMaterial({0.3f, 0.5f, 0.2f, 1}));
    small->scene.meshes.push_back(quad(1));
    small->world.pyramids.push_back(buildPyramid(small->scene.meshes[1]));
    const auto at = [](double x, double y, double z, double s) {
        return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, y, z)), glm::dvec3(s));
    };
    place(*small, 1, at(-2.05, 0, -4, 2));  // the two halves of the wall leave a gap in the middle
    place(*small, 1, at(2.05, 0, -4, 2));
    for (int i = 0; i < 9; ++i) place(*small, 0, at(i % 3 - 1, i / 3 - 1, -7 - 0.2 * i, 0.6));
    return small;
}

TEST_F(OccludedSurfaces, leavingThemOutChangesNoBit) {
    const auto small = behindAWall();
    for (const LodMode lod : {LodMode::off, LodMode::fractional, LodMode::continuous}) {
        RenderSettings settings = sharpLevels(70);
        settings.lod = lod;
        settings.metric = LodMetric::size;
        settings.thresholds.size = 1;
        settings.thresholds.blur = 0.0;
        const OpaqueDrawn drawn = opaqueDrawn("accumulation", *small, settings);
        EXPECT_GT(drawn.hidden, 0.2) << lodModeName(lod);
        EXPECT_TRUE(drawn.image.pixels == drawnWithAllHidden(*small, settings).pixels) << lodModeName(lod);
    }
}

TEST_F(OccludedSurfaces, wavesChangeNoBit) {
    const auto small = behindAWall();
    for (const char* method : {"accumulation", "multirate"}) {
        const OpaqueDrawn drawn = opaqueDrawn(method, *small, sharpLevels(70));
        ASSERT_GT(drawn.hidden, 0.2);
        for (const std::uint32_t wave : {1u, 3u, 64u}) {
            const OpaqueDrawn other = opaqueDrawn(method, *small, sharpLevels(70), wave);
            EXPECT_TRUE(drawn.image.pixels == other.image.pixels) << method << ", K = " << wave;
            EXPECT_EQ(drawn.hidden, other.hidden);
        }
    }
}

TEST_F(OccludedSurfaces, threadsChangeNoBit) {
    if (!drawsInThreads(currentDevice(), currentDriver())) GTEST_SKIP() << currentDriver() << " may crash";
    const auto small = behindAWall();
    for (const char* method : {"accumulation", "multirate"}) {
        const OpaqueDrawn drawn = opaqueDrawn(method, *small, sharpLevels(140));
        ASSERT_GT(drawn.hidden, 0.2);
        for (const std::uint32_t threads : {2u, 5u}) {
            const OpaqueDrawn other = opaqueDrawn(method, *small, sharpLevels(140), 0, threads);
            EXPECT_TRUE(drawn.image.pixels == other.image.pixels) << method << ", " << threads << " threads";
            EXPECT_EQ(drawn.hidden, other.hidden);
        }
    }
}

// Culling is also exact if everything is in focus. The plan then omits the lens, and samples differ only in their
// position inside the pixel.
TEST_F(OccludedSurfaces, ofAPinholeChangeNoBit) {
    const auto small = behindAWall();
    small->view.lens.dofEnabled = false;
    FramePlan plan = planFrame(small->world, small->view, sharpLevels(16));
    ASSERT_FALSE(plan.usesLens);
    const auto imageOf = [&](double minHidden) {
        const auto renderer = makeAccumulationRenderer(small->world, {});
        drawAllSamples(*renderer, plan);
        const RenderStats stats = renderer->stats();
        EXPECT_GE(static_cast<double>(stats.trianglesHidden), minHidden * static_cast<double>(stats.trianglesDrawn));
        return renderer->image();
    };
    const Image seen = imageOf(0.2);
    plan.settings.keepAll = true;  // turns culling off in the existing plan
    EXPECT_TRUE(seen.pixels == imageOf(0).pixels);
}

// A masked wall does not hide objects behind its holes, and a translucent wall does not hide any objects.
TEST_F(OccludedSurfaces, holesAndGlassHideNothing) {
    const double behindWall = opaqueDrawn("accumulation", *behindAWall(), sharpLevels(24)).hidden;
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const auto small = behindAWall();
        Material& wall = small->scene.materials[1];
        wall.alphaMode = mode;
        wall.alphaCutoff = 0.5f;
        wall.baseColorFactor.a = 0.4f;  // alpha below the cutoff, so the entire wall is a hole
        const OpaqueDrawn drawn = opaqueDrawn("accumulation", *small, sharpLevels(24));
        EXPECT_LT(drawn.hidden, behindWall - 0.1);
        EXPECT_TRUE(drawn.image.pixels == drawnWithAllHidden(*small, sharpLevels(24)).pixels);
    }
}

TEST_F(OccludedSurfaces, underLensesThatBendAndThingsThatMoveAllIsDrawn) {
    const auto small = behindAWall();
    small->view.lens.fieldCurvature = 0.3;
    EXPECT_EQ(opaqueDrawn("accumulation", *small, sharpLevels(24)).hidden, 0);
    small->view.lens.fieldCurvature = 0;
    small->world.shutter.poses.assign(2, small->world.pose);
    small->world.shutter.poses[1].objects[0].worldFromObject[3].x += 0.1;
    EXPECT_EQ(opaqueDrawn("accumulation", *small, sharpLevels(24)).hidden, 0);
}

// The helmet has layers of leather, rubber and glass that hide more than a fifth of its triangles.
TEST_F(OccludedSurfaces, ofFlightHelmet) {
    const std::filesystem::path path = modelPath("FlightHelmet/FlightHelmet.gltf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto small = posedWorld(path, 0, 0);
    small->view.width = 320;
    small->view.height = 240;
    small->view.lens.fStop = 0.1;
    const OpaqueDrawn drawn = opaqueDrawn("accumulation", *small, sharpLevels(24));
    EXPECT_GT(drawn.hidden, 0.2);
    EXPECT_TRUE(drawn.image.pixels == drawnWithAllHidden(*small, sharpLevels(24)).pixels);
}

}  // namespace
}  // namespace defocus::engine
