// Slow tests of a pane of glass in front of a blurred scene.

#include "likeness.h"
#include "render/glass_wall.h"

namespace defocus::engine {
namespace {

// A pane in front of all spheres that neither reflects nor tints leaves the blurred image unchanged, because in each
// lens sample the pane shows that sample's background.
TEST_F(Transmission, aPaneThatDoesNothingLeavesTheBlurAsItIs) {
    const auto without = fiveSpheres();
    const auto with = fiveSpheres();
    addWall(*with, 0.6, clear(), 2);
    with->scene.meshes.back().vertices.colors.clear();
    finish(*with);
    const Image expected = drawnBy("accumulation", *without, 64);
    const Image image = drawnBy("accumulation", *with, 64);
    EXPECT_LT(largestDifference(image, expected), 2e-5);
}

}  // namespace
}  // namespace defocus::engine
