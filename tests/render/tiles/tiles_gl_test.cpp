// Frames drawn tile by tile have the bits of a frame drawn in one piece, for all tilings, levels, motions and blur
// controls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gl/context.h"
#include "likeness.h"
#include "plan/visible/tiles.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Tiles : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<GlContext> context_;
};
std::unique_ptr<GlContext> Tiles::context_;

PixelRectangle wholeOf(const FramePlan& plan) {
    return {0, 0, plan.view.width, plan.view.height};
}

// Assembles the image from tiles, each with its own start; NaN where there is no tile.
Image joined(Renderer& renderer, const FramePlan& plan, const std::vector<Tile>& tiles) {
    Image image(plan.view.width, plan.view.height, 4);
    std::ranges::fill(image.pixels, std::numeric_limits<float>::quiet_NaN());
    for (const Tile& tile : tiles) {
        const Image part = imageOf(renderer, tileOf(plan, tile));
        if (part.width != tile.area.width || part.height != tile.area.height) {
            ADD_FAILURE() << part.width << " x " << part.height;
            return image;
        }
        for (int y = 0; y < part.height; ++y)
            std::copy_n(part.at(0, y), 4 * part.width, image.at(tile.area.left, tile.area.top + y));
    }
    return image;
}

// Tiles of uneven sizes in one cell.
std::vector<Tile> unevenTiles(const FramePlan& plan) {
    const int columns[] = {0, 37, 101, plan.view.width};
    const int rows[] = {0, 13, 64, plan.view.height};
    std::vector<Tile> tiles;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            tiles.push_back({{columns[x], rows[y], columns[x + 1] - columns[x], rows[y + 1] - rows[y]}, wholeOf(plan)});
    return tiles;
}

void expectTheBitsOfOnePiece(const SmallWorld& small, const FramePlan& plan, const char* what) {
    RendererOptions options;
    const auto full = methodNamed("accumulation").make(small.world, options);
    options.wave = 3;
    const auto parts = methodNamed("accumulation").make(small.world, options);
    const Image expected = imageOf(*full, plan);
    const Image found = joined(*parts, plan, unevenTiles(plan));
    std::size_t others = 0, first = found.pixels.size();
    for (std::size_t i = found.pixels.size(); i-- > 0;)
        if (!(found.pixels[i] == expected.pixels[i])) ++others, first = i;
    if (others == 0) return;
    const auto width = static_cast<std::size_t>(4 * expected.width);
    ADD_FAILURE() << what << ": " << others << " values, the first at " << first % width / 4 << ", " << first / width
                  << ", channel " << first % 4 << ": " << found.pixels[first] << " instead of "
                  << expected.pixels[first] << ", by at most " << largestDifference(found, expected);
}

FramePlan planWith(const SmallWorld& small, const View& view, LodMode mode = LodMode::fractional,
                   std::uint32_t samples = 20) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = mode;
    settings.thresholds = {0.5, 2};
    return planFrame(small.world, view, settings);
}

TEST_F(Tiles, haveTheBitsOfOnePieceAtEachKindOfLevel) {
    const auto small = fiveSpheres();
    for (const LodMode mode : {LodMode::off, LodMode::fractional, LodMode::continuous})
        // 70 samples: two blocks
        expectTheBitsOfOnePiece(*small, planWith(*small, small->view, mode, 70), lodModeName(mode));
}

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
    auto map = std::make_shared<Image>(16, 8, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = static_cast<float>(i * 37 % 101) / 50;
    small->world.environment.type = EnvironmentType::map;
    small->world.environment.map = map;
    expectTheBitsOfOnePiece(*small, planWith(*small, small->view), "map");
    small->world.environment = {};
    small->world.environment.type = EnvironmentType::none;
    expectTheBitsOfOnePiece(*small, planWith(*small, small->view), "no background");
}

// Objects outside a tile, or outside the image, cast shadows into the tile.
TEST_F(Tiles, haveTheBitsOfOnePieceWhereShadowsFallIntoThem) {
    const auto small = fiveSpheres();
    RenderSettings settings;
    settings.sampleCount = 20;
    settings.shadows = Shadows::on;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    ASSERT_FALSE(plan.shadows.maps.empty());
    expectTheBitsOfOnePiece(*small, plan, "shadows");
}

// A transmitting object shows other pixels of the image, which may lie outside the tile.
TEST_F(Tiles, haveTheBitsOfOnePieceWhereGlassShowsWhatLiesElsewhere) {
    const auto small = fiveSpheres();
    Material glass;
    glass.transmissionFactor = 1;
    glass.thicknessFactor = 1;
    glass.roughnessFactor = 0.3f;
    small->scene.materials.front() = glass;
    const FramePlan plan = planWith(*small, small->view);
    ASSERT_TRUE(plan.usesTransmission);
    expectTheBitsOfOnePiece(*small, plan, "glass");
}

// In an image of several cells, the only difference is that each cell rounds window coordinates in its own way.
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
    const auto renderer = methodNamed("accumulation").make(small->world, {});
    const Image full = imageOf(*renderer, plan);
    const Image parts = joined(*renderer, plan, tiles);
    EXPECT_TRUE(joined(*renderer, plan, halves).pixels == parts.pixels) << "tiles of a cell";
    double largest = 0, squared = 0;
    for (std::size_t i = 0; i < full.pixels.size(); ++i) {
        const double difference = full.pixels[i] - parts.pixels[i];
        largest = std::max(largest, std::abs(difference));
        squared += difference * difference;
    }
    // In one of 70 samples, a silhouette's corner may round to another pixel.
    EXPECT_LT(largest, 2.0 / 70);
    EXPECT_LT(std::sqrt(squared / static_cast<double>(full.pixels.size())), 1e-4);
}

}  // namespace
}  // namespace defocus::engine
