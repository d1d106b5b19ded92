// Tests meshes whose vertices lie far from the origin of their object space.

#include <gtest/gtest.h>

#include "gl/context.h"
#include "image/metrics.h"
#include "render/gpu_scene/gpu_scene.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

Bounds boxAround(const glm::dvec3& middle, double reach) {
    Bounds bounds;
    bounds.extend(middle - reach);
    bounds.extend(middle + reach);
    return bounds;
}

TEST(MeshOrigin, staysWhereTheMeshIsNear) {
    EXPECT_EQ(meshOrigin(Bounds{}), glm::dvec3(0));
    EXPECT_EQ(meshOrigin(boxAround({1, -2, 0}, 1)), glm::dvec3(0));
}

TEST(MeshOrigin, movesAlongTheAxesOnWhichTheMeshIsFar) {
    EXPECT_EQ(meshOrigin(boxAround({17'000, 2, -8}, 1)), glm::dvec3(17'000, 0, -8));
}

// Returns a mesh whose vertices are shifted by `offset` and moved back by the object's matrix. All coordinates are
// multiples of 1/8, so nothing is rounded.
std::unique_ptr<SmallWorld> shiftedBoard(const glm::vec3& offset, bool morphed) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({1, 1, 1, 1}));
    Mesh board = bumpySphere(24, 16, 0);
    for (glm::vec3& position : board.vertices.positions) position = glm::round(position * 8.0f) / 8.0f + offset;
    if (morphed) {
        board.morphTargets.push_back({std::vector<glm::vec3>(board.vertices.count(), {0.5f, 0, 0}), {}, {}});
        board.morphWeights = {0.5f};
    }
    small->scene.meshes.push_back(std::move(board));
    const glm::dmat4 there = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.1, 0, -4)), 0.7, {0.3, 1, 0.2});
    place(*small, 0, glm::translate(there, -glm::dvec3(offset)));
    if (morphed) small->world.pose.objects[0].morphWeights = {0.5};
    small->world.environment.type = EnvironmentType::none;
    small->view.width = 96;
    small->view.height = 72;
    small->view.lens.focusDistance = 4;
    finish(*small);
    return small;
}

Image shiftedImage(SmallWorld& small, double cameraX) {
    small.view.worldFromCamera = glm::translate(glm::dmat4(1), glm::dvec3(cameraX, 0, 0));
    const RenderSettings settings{.sampleCount = 16, .lod = LodMode::off};
    return imageInFloats(small.world, planFrame(small.world, small.view, settings));
}

// A mesh far from its object's origin looks like the same mesh around the origin. The camera moves in steps of 0.5 mm
// to reveal rounding errors.
TEST(FarMesh, looksLikeTheSameMeshAroundItsOrigin) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    for (const bool morphed : {false, true}) {
        const auto near = shiftedBoard(glm::vec3(0), morphed);
        const auto far = shiftedBoard({131'072, -65'536, 32'768}, morphed);
        for (int i = 0; i < 4; ++i) {
            const double x = 5e-4 * i;
            EXPECT_LE(compareImages(shiftedImage(*near, x), shiftedImage(*far, x)).rmse, 1e-3) << x << ' ' << morphed;
        }
    }
}

}  // namespace
}  // namespace defocus::engine
