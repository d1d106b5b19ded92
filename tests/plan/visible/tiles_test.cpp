// Tests the division of an image. Rasterization cells (parts with separate viewports) and ranges of rows cover each
// pixel once, and a tile's plan keeps all objects that may be visible in the tile.

#include "plan/visible/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plan/frame_plan.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

TEST(Cells, coverTheImageOnceAndFollowFromItsSize) {
    for (const auto& [width, height] : {std::pair{640, 480}, {8192, 8192}, {8193, 16}, {16384, 10001}}) {
        std::int64_t pixels = 0;
        for (const PixelRectangle& cell : cellsOf(width, height)) {
            EXPECT_LE(std::max(cell.width, cell.height), maxCellPixels);
            EXPECT_GE(std::min({cell.left, cell.top, cell.width - 1, cell.height - 1}), 0);
            EXPECT_LE(cell.left + cell.width, width);
            EXPECT_LE(cell.top + cell.height, height);
            pixels += std::int64_t{cell.width} * cell.height;
        }
        EXPECT_EQ(pixels, std::int64_t{width} * height);
    }
    EXPECT_EQ(cellsOf(8192, 8192).size(), 1u);
    EXPECT_EQ(cellsOf(16384, 10001).size(), 4u);
}

TEST(RowsOfParts, coverTheImageOnce) {
    for (const int count : {1, 2, 7, 100}) {
        int next = 0;
        for (int i = 0; i < count; ++i) {
            const RowRange rows = rowsOfPart(100, i, count);
            EXPECT_EQ(rows.first, next);
            EXPECT_GT(rows.end, rows.first);
            next = rows.end;
        }
        EXPECT_EQ(next, 100);
    }
}

FramePlan planOf(const SmallWorld& small) {
    const RenderSettings settings{.sampleCount = 16};
    return planFrame(small.world, small.view, settings);
}

std::vector<int> objectsOf(const FramePlan& plan) {
    std::vector<int> objects;
    for (const ObjectPlan& object : plan.objects) objects.push_back(object.object);
    std::ranges::sort(objects);
    return objects;
}

// A tile's plan keeps every object that may appear in the tile in any sample, and removes all other objects.
TEST(TilePlan, holdsTheObjectsThatASampleMayShowThere) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small);
    const PixelRectangle full{0, 0, plan.view.width, plan.view.height};
    EXPECT_EQ(objectsOf(tileOf(plan, {full, full})), objectsOf(plan));

    // Object 1 lies in focus at (0.3, 0.2, −3) with a radius of 0.53. It covers the columns from `left` to `right`.
    const double focal = plan.view.width / (2 * plan.tanHalfHorizontal);
    const int left = static_cast<int>(plan.view.width / 2 + focal * (0.3 - 0.53) / 3);
    const int right = static_cast<int>(plan.view.width / 2 + focal * (0.3 + 0.53) / 3) + 1;
    const auto shows = [&](const PixelRectangle& area) {
        const std::vector<int> objects = objectsOf(tileOf(plan, {area, full}));
        return std::ranges::find(objects, 1) != objects.end();
    };
    EXPECT_TRUE(shows({left, 0, right - left, plan.view.height}));
    EXPECT_TRUE(shows({(left + right) / 2, plan.view.height / 2, 1, 1}));
    ASSERT_GT(left, 24);
    EXPECT_FALSE(shows({0, 0, left - 16, plan.view.height}));
}

TEST(TilePlan, keepsLevelsAndSamples) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small);
    const FramePlan tile = tileOf(plan, {{0, 0, 32, 32}, {0, 0, plan.view.width, plan.view.height}});
    EXPECT_EQ(tile.samples.size(), plan.samples.size());
    for (const ObjectPlan& object : tile.objects) {
        const auto same = std::ranges::find(plan.objects, object.object, &ObjectPlan::object);
        ASSERT_NE(same, plan.objects.end());
        EXPECT_EQ(object.lambda, same->lambda);
        EXPECT_EQ(object.coarse.sampleCount, same->coarse.sampleCount);
    }
    EXPECT_LE(tile.trianglesDrawn, plan.trianglesDrawn);
}

}  // namespace
}  // namespace defocus::engine
