#include "render/occlusion/depth_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace defocus::engine {
namespace {

struct DepthRows {
    int width, height;
    std::vector<float> values;

    [[nodiscard]] float min(int left, int right, int bottom, int top) const {
        float min = 1;
        for (int y = bottom; y < top; ++y)
            for (int x = left; x < right; ++x) min = std::min(min, values[static_cast<std::size_t>(y * width + x)]);
        return min;
    }
};

// Returns rows of reversed depth values (1 is near). 1 % of the pixels are holes that show far surfaces.
DepthRows depthsWithHoles(int width, int height, std::mt19937& random) {
    DepthRows depths{width, height, {}};
    std::uniform_real_distribution<float> near(0.5f, 1.0f);
    std::bernoulli_distribution hole(0.01);
    for (int i = 0; i < width * height; ++i) depths.values.push_back(hole(random) ? 0.1f * near(random) : near(random));
    return depths;
}

TEST(DepthTiles, neverFartherThanAnyPixelAsked) {
    std::mt19937 random(1);
    for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {64, 64}, {161, 77}}) {
        const DepthRows depths = depthsWithHoles(width, height, random);
        DepthTiles tiles;
        tiles.build(depths.values, width, height);
        for (int i = 0; i < 2000; ++i) {
            const auto [left, right] = std::minmax({std::uniform_int_distribution(0, width - 1)(random),
                                                    std::uniform_int_distribution(0, width - 1)(random)});
            const auto [bottom, top] = std::minmax({std::uniform_int_distribution(0, height - 1)(random),
                                                    std::uniform_int_distribution(0, height - 1)(random)});
            ASSERT_LE(tiles.farthest(left, right + 1, bottom, top + 1), depths.min(left, right + 1, bottom, top + 1));
        }
    }
}

// The farthest depth of a range of pixels is computed from tiles. A far pixel may affect ranges next to it, but not
// ranges more than a tile away.
TEST(DepthTiles, aHoleReachesNoFartherThanATile) {
    DepthRows depths{200, 100, std::vector<float>(200 * 100, 0.5f)};
    depths.values[50 * 200 + 100] = 0;
    DepthTiles tiles;
    tiles.build(depths.values, 200, 100);
    EXPECT_EQ(tiles.farthest(100, 101, 50, 51), 0.0f);
    EXPECT_EQ(tiles.farthest(90, 98, 40, 48), 0.5f);
    EXPECT_EQ(tiles.farthest(106, 112, 50, 56), 0.5f);
    EXPECT_EQ(tiles.farthest(0, 60, 0, 100), 0.5f);
}

}  // namespace
}  // namespace defocus::engine
