// Tests that culling of clusters (groups of triangles) leaves images of large models bit-identical.

#include "render/visibility.h"

namespace defocus::engine {
namespace {

TEST_P(VisibilityOf, leavingOutChangesNothing) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam());
    expectSameImages(path);
}

INSTANTIATE_TEST_SUITE_P(Models, VisibilityOf, testing::Values("FlightHelmet/FlightHelmet.gltf", "WaterBottle.glb"),
                         [](const auto& tested) { return testNameOf(tested.param); });

}  // namespace
}  // namespace defocus::engine
