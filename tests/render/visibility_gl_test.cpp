// Culling of clusters does not change a bit of the image.

#include <gtest/gtest.h>

#include "gl/context.h"
#include "models.h"
#include "posed_world.h"
#include "render/aov/work.h"
#include "render/methods.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Visibility : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<GlContext> context_;
};
std::unique_ptr<GlContext> Visibility::context_;

RenderSettings settingsFor(LodMode lod, bool keepAll) {
    RenderSettings settings;
    settings.sampleCount = 24;
    settings.lod = lod;
    settings.thresholds = {0.5, 2};
    settings.keepAll = keepAll;
    return settings;
}

Image rendered(const SmallWorld& small, const FramePlan& plan, std::uint32_t wave) {
    RendererOptions options;
    options.wave = wave;
    const auto renderer = methodNamed("accumulation").make(small.world, options);
    renderer->start(plan);
    while (renderer->advance()) {
    }
    EXPECT_EQ(renderer->stats().trianglesDrawn, plan.trianglesDrawn);
    return renderer->image();
}

// Returns the plan with all of its triangles drawn.
FramePlan drawnWhole(const SmallWorld& small, FramePlan plan) {
    plan.trianglesDrawn += plan.trianglesFacingAway + plan.trianglesOutside;
    for (ObjectPlan& object : plan.objects) {
        object.visible.clear();
        for (LevelDraw* draw : {&object.coarse, &object.fine})
            draw->triangleCount =
                small.world.pyramids[static_cast<std::size_t>(object.mesh)].levels[draw->level].triangleCount;
    }
    return plan;
}

// Expects the same image with and without culling. Returns the culled share of the triangles.
double expectSameImage(const SmallWorld& small, LodMode lod) {
    const FramePlan seen = planFrame(small.world, small.view, settingsFor(lod, false));
    const FramePlan all = drawnWhole(small, seen);
    EXPECT_TRUE(rendered(small, all, 0).pixels == rendered(small, seen, 5).pixels);
    EXPECT_TRUE(renderWork(small.world, all).pixels == renderWork(small.world, seen).pixels);
    return static_cast<double>(seen.trianglesFacingAway + seen.trianglesOutside) /
           static_cast<double>(all.trianglesDrawn);
}

TEST_F(Visibility, keepingAllGivesTheSameImage) {
    const auto small = fiveSpheres();
    const FramePlan all = planFrame(small->world, small->view, settingsFor(LodMode::fractional, true));
    const FramePlan seen = planFrame(small->world, small->view, settingsFor(LodMode::fractional, false));
    EXPECT_LT(seen.trianglesDrawn, 0.9 * static_cast<double>(all.trianglesDrawn));
    EXPECT_TRUE(rendered(*small, all, 3).pixels == rendered(*small, seen, 3).pixels);
}

TEST_F(Visibility, spheresAtAllLevelsOfDetail) {
    const auto small = fiveSpheres();
    for (const LodMode lod : {LodMode::off, LodMode::fractional, LodMode::continuous})
        EXPECT_GT(expectSameImage(*small, lod), lod == LodMode::off ? 0.2 : 0.1) << lodModeName(lod);
}

TEST_F(Visibility, underLimitsRangesAndTiltedPlanes) {
    for (int variant = 0; variant < 4; ++variant) {
        const auto small = fiveSpheres();
        Lens& lens = small->view.lens;
        if (variant == 0) lens.foregroundLimit = 3;
        if (variant == 1) lens.backgroundLimit = 3;
        if (variant == 2) lens.focusRangeBehind = 1;
        if (variant == 3) lens.focusTilt = 0.4;
        EXPECT_GT(expectSameImage(*small, LodMode::off), 0.15) << variant;
    }
}

// If C is curved, or differs between vertices, corners are tested (visibility.h).
TEST_F(Visibility, curvedFocus) {
    const auto small = fiveSpheres();
    small->view.lens.fieldCurvature = 0.3;
    EXPECT_GT(expectSameImage(*small, LodMode::off), 0.15);
}

TEST_F(Visibility, blurOfVertices) {
    for (const bool changes : {false, true}) {
        const auto small = fiveSpheres();
        Mesh& mesh = small->scene.meshes[0];
        for (const glm::vec3& p : mesh.vertices.positions)
            mesh.vertices.blurs.push_back({1 + 0.3f * p.y, 0.5f * p.x, changes ? -0.5f * p.x : 0.5f * p.x});
        mesh.blurBounds = boundsOf(mesh.vertices.blurs);
        small->world.pyramids = {};
        small->world.pyramids.push_back(fullDetail(mesh));
        if (changes) small->world.shutter.poses.assign(2, small->world.pose);
        EXPECT_GT(expectSameImage(*small, LodMode::off), 0.15) << changes;
    }
}

TEST_F(Visibility, blendedSurfaces) {
    const auto small = fiveSpheres();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.6f;
    EXPECT_GT(expectSameImage(*small, LodMode::off), 0.2);
}

// Double-sided surfaces show their backs, so nothing is culled.
TEST_F(Visibility, doubleSidedSurfacesLeaveNothingOut) {
    const auto small = fiveSpheres();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.6f;
    small->scene.materials[0].doubleSided = true;
    EXPECT_EQ(expectSameImage(*small, LodMode::off), 0);
}

TEST_F(Visibility, spheresThatMoveAndTurn) {
    const auto small = fiveSpheres();
    small->world.shutter.poses.assign(3, small->world.pose);
    for (std::size_t i = 0; i < 3; ++i)
        for (Object& object : small->world.shutter.poses[i].objects)
            object.worldFromObject =
                glm::rotate(glm::translate(object.worldFromObject, glm::dvec3(0.1 * static_cast<double>(i), 0, 0)),
                            0.2 * static_cast<double>(i), glm::dvec3(0, 1, 0));
    EXPECT_GT(expectSameImage(*small, LodMode::off), 0.15);
}

double expectSameImages(const std::filesystem::path& path) {
    const auto small = posedWorld(path, 0, 0);
    small->view.lens.fStop = 0.5;
    return std::max(expectSameImage(*small, LodMode::off), expectSameImage(*small, LodMode::fractional));
}

TEST_F(Visibility, filesOfTheRepository) {
    double max = 0;
    for (const char* name : {"meshes/fish.glb", "meshes/reed.glb", "NegativeScaleTest.glb", "SimpleInstancing.glb"}) {
        SCOPED_TRACE(name);
        max = std::max(max, expectSameImages(modelPath(name)));
    }
    EXPECT_GT(max, 0.02);
}

// Scanned and modelled surfaces with needles, folds and holes.
class VisibilityOf : public Visibility, public testing::WithParamInterface<const char*> {};

TEST_P(VisibilityOf, leavingOutChangesNothing) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam());
    expectSameImages(path);
}

INSTANTIATE_TEST_SUITE_P(Models, VisibilityOf,
                         testing::Values("FlightHelmet/FlightHelmet.gltf", "Suzanne.glb", "WaterBottle.glb"),
                         [](const auto& tested) { return testNameOf(tested.param); });

}  // namespace
}  // namespace defocus::engine
