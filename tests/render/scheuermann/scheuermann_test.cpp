#include "render/scheuermann/scheuermann.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace defocus::engine {
namespace {

constexpr int width = 1000;

ClipCircleOfConfusion cocOf(double fStop, double focusDistance) {
    const Lens lens{.fStop = fStop, .focusDistance = focusDistance};
    return clipCircleOfConfusion(lens, 1024, 768);
}

TEST(BlurrinessPlanes, lieWhereTheThinLensReachesTheLargestBlur) {
    const ClipCircleOfConfusion coc = cocOf(1, 2);
    const BlurrinessPlanes planes = blurrinessPlanes(coc, 2, 10, width);
    EXPECT_NEAR(circleOfConfusion(coc, planes.near, width), -10, 1e-9);
    EXPECT_NEAR(circleOfConfusion(coc, planes.far, width), 10, 1e-9);
    EXPECT_EQ(planes.focus, 2);
    EXPECT_EQ(planes.cutoff, 1);
}

TEST(BlurrinessPlanes, whereInfinityIsLessBlurredTheCutoffIsItsBlur) {
    const ClipCircleOfConfusion coc = cocOf(16, 4);
    const double atInfinity = circleOfConfusion(coc, std::numeric_limits<double>::infinity(), width);
    ASSERT_LT(atInfinity, 10);
    const BlurrinessPlanes planes = blurrinessPlanes(coc, 4, 10, width);
    EXPECT_NEAR(planes.cutoff, atInfinity / 10, 1e-12);
    // At 8 m, twice the focus distance, the method's linear blur and the lens's blur are both half of their value at
    // infinity.
    EXPECT_NEAR((8 - planes.focus) / (planes.far - planes.focus), 0.5 * planes.cutoff, 1e-12);
    EXPECT_NEAR(circleOfConfusion(coc, 8, width), 0.5 * atInfinity, 1e-9);
}

TEST(BlurrinessPlanes, focusAtInfinityBlursNothingBehind) {
    const BlurrinessPlanes planes = blurrinessPlanes(cocOf(1, std::numeric_limits<double>::infinity()),
                                                     std::numeric_limits<double>::infinity(), 10, width);
    EXPECT_EQ(planes.cutoff, 0);
    EXPECT_GT(planes.near, 0);
    EXPECT_TRUE(std::isfinite(planes.near));
}

TEST(BlurrinessPlanes, setByHandReplaceThoseOfTheLens) {
    const BlurrinessPlanes lens{1, 2, 4, 0.8};
    const BlurrinessPlanes same = withPlanesByHand(lens, {});
    EXPECT_EQ(same.near, 1);
    EXPECT_EQ(same.focus, 2);
    EXPECT_EQ(same.far, 4);
    EXPECT_EQ(same.cutoff, 0.8);
    const BlurrinessPlanes all = withPlanesByHand(lens, {3, 5, 6, 0.5});
    EXPECT_EQ(all.near, 3);
    EXPECT_EQ(all.focus, 5);
    EXPECT_EQ(all.far, 6);
    EXPECT_EQ(all.cutoff, 0.5);
    // If only the focal plane is set, the near and the far plane are scaled in proportion.
    const BlurrinessPlanes moved = withPlanesByHand(lens, {.focus = 6});
    EXPECT_DOUBLE_EQ(moved.near, 3);
    EXPECT_DOUBLE_EQ(moved.far, 12);
    EXPECT_THROW(withPlanesByHand(lens, {.near = 2}), Error);
    EXPECT_THROW(withPlanesByHand(lens, {.far = 1.5}), Error);
}

// The n points of a Poisson disk keep a min distance d. Disks of radius d/2 around them have n·d²/4 of the unit disk's
// area. They do not overlap and lie in a disk of radius 1 + d/2, of which they fill at most π/√12 (Groemer 1960). No
// gap is left, so disks of radius d cover the unit disk. Hence n·d² > 1, and in practice n·d²/4 > 0.3. As the number of
// candidates is finite, gaps up to 1.1·d are tolerated.
TEST(PoissonDisk, keepsItsDistanceAndLeavesNoGap) {
    for (const std::uint32_t count : {8u, 12u, 24u, 64u}) {
        std::vector<glm::vec2> points = poissonDisk(count);
        ASSERT_EQ(points.size(), count);
        points.emplace_back(0);  // the centre is not a tap, but taps keep the min distance from it
        double min = 2;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_LE(glm::length(points[i]), 1.0f + 1e-6f);
            for (std::size_t j = 0; j < i; ++j)
                min = std::min(min, static_cast<double>(glm::distance(points[i], points[j])));
        }
        const double filled = static_cast<double>(points.size()) * min * min / 4;
        EXPECT_GT(filled, 0.3) << count;
        EXPECT_LE(filled, std::numbers::pi / std::sqrt(12.0) * std::pow(1 + min / 2, 2)) << count;
        double widestGap = 0;
        constexpr int steps = 100;
        for (int y = -steps; y <= steps; ++y)
            for (int x = -steps; x <= steps; ++x) {
                const glm::vec2 place = glm::vec2(x, y) / static_cast<float>(steps);
                if (glm::length(place) > 1) continue;
                double nearest = 2;
                for (const glm::vec2& point : points)
                    nearest = std::min(nearest, static_cast<double>(glm::distance(place, point)));
                widestGap = std::max(widestGap, nearest);
            }
        EXPECT_LE(widestGap, 1.1 * min) << count;
    }
}

}  // namespace
}  // namespace defocus::engine
