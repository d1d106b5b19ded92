// Tests that images drawn in tiles equal undivided images bit for bit, for all tilings, motions and blur controls.

#include <algorithm>
#include <cmath>

#include "render/accumulation/accumulation.h"
#include "render/tiles/tiled_image.h"

namespace defocus::engine {
namespace {

TEST_F(Tiles, haveTheBitsOfOnePieceWithControlsOfTheBlur) {
    const auto small = fiveSpheres();
    View view = small->view;
    view.lens.catEye = 0.7;
    expectTheBitsOfOnePiece(*small, planWith(*small, view), "cat's eye");
    view = small->view;
    view.lens.axialChromaticAberration = 0.3;
    expectTheBitsOfOnePiece(*small, planWith(*small, view), "wavelengths");
    view = small->view;
    view.lens.fieldCurvature = 1;
    expectTheBitsOfOnePiece(*small, planWith(*small, view), "curved focus");
}

TEST_F(Tiles, haveTheBitsOfOnePieceWhileObjectsAndCameraMove) {
    const auto small = fiveSpheres();
    View view = small->view;
    Pose& pose = small->world.pose;
    small->world.shutter.poses = {pose, pose};
    for (std::size_t i = 0; i < pose.objects.size(); ++i)
        small->world.shutter.poses[1].objects[i].worldFromObject =
            glm::translate(glm::dmat4(1), glm::dvec3(0.2, 0.1, 0.05)) * pose.objects[i].worldFromObject;
    view.shutterCameras = {view.worldFromCamera, glm::rotate(view.worldFromCamera, 0.05, glm::dvec3(0, 1, 0))};
    const FramePlan plan = planWith(*small, view);
    ASSERT_FALSE(plan.moments.empty());
    ASSERT_FALSE(plan.middleFromView.empty());
    expectTheBitsOfOnePiece(*small, plan, "motion");
}

TEST_F(Tiles, haveTheBitsOfOnePieceBeforeAMapAndBeforeNothing) {
    const auto small = fiveSpheres();
    small->world.environment = speckledMap();
    expectTheBitsOfOnePiece(*small, planWith(*small, small->view), "map");
    small->world.environment = {};
    small->world.environment.type = EnvironmentType::none;
    expectTheBitsOfOnePiece(*small, planWith(*small, small->view), "no background");
}

// Some tiles contain only a few of the blended objects. The sky behind these objects is transparent.
TEST_F(Tiles, haveTheBitsOfOnePieceWhereSurfacesBlend) {
    const auto small = fiveSpheres();
    small->world.environment.type = EnvironmentType::none;
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.4f;
    const FramePlan plan = planWith(*small, small->view);
    ASSERT_FALSE(plan.blendOrder.empty());
    expectTheBitsOfOnePiece(*small, plan, "blending");
}

// Images drawn in tiles are exact even if objects outside the tile, or outside the image, cast shadows into it.
TEST_F(Tiles, haveTheBitsOfOnePieceWhereShadowsFallIntoThem) {
    const auto small = fiveSpheres();
    const RenderSettings settings{.sampleCount = 20, .shadows = Shadows::on};
    const FramePlan plan = planFrame(small->world, small->view, settings);
    ASSERT_FALSE(plan.shadows.maps.empty());
    expectTheBitsOfOnePiece(*small, plan, "shadows");
}

// An image that is drawn in several rasterization cells (parts with separate viewports) has no seams. It differs from
// an undivided image only because each cell rounds window coordinates differently.
TEST_F(Tiles, ofSeveralCellsJoinWithoutASeam) {
    const auto small = fiveSpheres();
    const FramePlan plan = planWith(*small, small->view, LodMode::continuous, 70);
    const PixelRectangle cells[] = {{0, 0, 80, 64}, {80, 0, 80, 64}, {0, 64, 80, 56}, {80, 64, 80, 56}};
    std::vector<Tile> tiles, halves;
    for (const PixelRectangle& cell : cells) {
        tiles.push_back({cell, cell});
        halves.push_back({{cell.left, cell.top, cell.width, 20}, cell});
        halves.push_back({{cell.left, cell.top + 20, cell.width, cell.height - 20}, cell});
    }
    const auto renderer = makeAccumulationRenderer(small->world, {});
    const Image full = imageOf(*renderer, plan);
    const Image parts = joined(*renderer, plan, tiles);
    EXPECT_TRUE(joined(*renderer, plan, halves).pixels == parts.pixels) << "tiles of a cell";
    double largest = 0, squared = 0;
    for (std::size_t i = 0; i < full.pixels.size(); ++i) {
        const double difference = full.pixels[i] - parts.pixels[i];
        largest = std::max(largest, std::abs(difference));
        squared += difference * difference;
    }
    // In one of 70 samples, a corner of the silhouette may round to another pixel.
    EXPECT_LT(largest, 2.0 / 70);
    EXPECT_LT(std::sqrt(squared / static_cast<double>(full.pixels.size())), 1e-4);
}

}  // namespace
}  // namespace defocus::engine
