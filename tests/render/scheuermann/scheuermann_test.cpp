#include "render/scheuermann/scheuermann.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace defocus {
namespace {

constexpr int width = 1000;

ClipCircleOfConfusion cocOf(double fStop, double focusDistance) {
    Lens lens;
    lens.fStop = fStop;
    lens.focusDistance = focusDistance;
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
    // The line meets the lens at half the blur of infinity, which is at twice the focus distance.
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

TEST(PoissonDisk, keepsItsDistanceInsideTheUnitDisk) {
    for (const std::uint32_t count : {8u, 12u, 24u, 64u}) {
        const std::vector<glm::vec2> points = poissonDisk(count);
        ASSERT_EQ(points.size(), count);
        EXPECT_EQ(points.front(), glm::vec2(0));
        float least = 2;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_LE(glm::length(points[i]), 1.0f + 1e-6f);
            for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::distance(points[i], points[j]));
        }
        // Disks of half the least distance around the points fill more than a quarter of the disk (random points: 1/n
        // of that), and cannot fill more than hexagons would.
        const double filled = count * least * least / 4;
        EXPECT_GT(filled, 0.3) << count;
    }
}

}  // namespace
}  // namespace defocus
