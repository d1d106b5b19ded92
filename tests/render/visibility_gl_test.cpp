// Tests that culling of clusters (groups of triangles) leaves the image bit-identical.

#include "models.h"
#include "render/visibility.h"

namespace defocus::engine {
namespace {

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

// With a curved focus surface, clusters are culled only outside the frustum (visibility.h).
TEST_F(Visibility, curvedFocus) {
    const auto small = fiveSpheres();
    small->view.lens.fieldCurvature = 0.3;
    expectSameImage(*small, LodMode::off);
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
        SCOPED_TRACE(changes);
        expectSameImage(*small, LodMode::off);
    }
}

TEST_F(Visibility, blendedSurfaces) {
    const auto small = fiveSpheres();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.6f;
    EXPECT_GT(expectSameImage(*small, LodMode::off), 0.2);
}

// Double-sided surfaces show their back faces, so nothing is culled.
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

TEST_F(Visibility, filesOfTheRepository) {
    double max = 0;
    for (const char* name : {"meshes/fish.glb", "meshes/reed.glb", "NegativeScaleTest.glb", "SimpleInstancing.glb"}) {
        SCOPED_TRACE(name);
        max = std::max(max, expectSameImages(modelPath(name)));
    }
    EXPECT_GT(max, 0.02);
}

TEST_P(VisibilityOf, leavingOutChangesNothing) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam());
    expectSameImages(path);
}

INSTANTIATE_TEST_SUITE_P(Models, VisibilityOf, testing::Values("Suzanne.glb"),
                         [](const auto& tested) { return testNameOf(tested.param); });

}  // namespace
}  // namespace defocus::engine
