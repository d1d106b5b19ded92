// Slow tests: images drawn in tiles are bit-identical to undivided images, in each mode of levels of detail and behind
// glass.

#include "render/tiles/tiled_image.h"

namespace defocus::engine {
namespace {

TEST_F(Tiles, haveTheBitsOfOnePieceAtEachKindOfLevel) {
    const auto small = fiveSpheres();
    for (const LodMode mode : {LodMode::off, LodMode::fractional, LodMode::continuous})
        // 70 samples are drawn in two blocks of at most 64 samples
        expectTheBitsOfOnePiece(*small, planWith(*small, small->view, mode, 70), lodModeName(mode));
}

// Images drawn in tiles are bit-identical to undivided images even if a transmitting object refracts parts of the image
// that lie outside the tile.
TEST_F(Tiles, haveTheBitsOfOnePieceWhereGlassShowsWhatLiesElsewhere) {
    const auto small = fiveSpheres();
    const Material glass{.roughnessFactor = 0.3f, .transmissionFactor = 1, .thicknessFactor = 1};
    small->scene.materials.front() = glass;
    const FramePlan plan = planWith(*small, small->view);
    ASSERT_TRUE(plan.usesTransmission);
    expectTheBitsOfOnePiece(*small, plan, "glass");
}

}  // namespace
}  // namespace defocus::engine
