#include "plan/lens_cells/even_division.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "aperture_shapes.h"

namespace defocus::engine {
namespace {

std::vector<LensSample> samplesOfLens(const Lens& lens, std::uint32_t first, std::uint32_t count) {
    return lensSamples(lens, Sequence::sobol, first, count, 0);
}

// Returns the mean squared distance of lens points from their mean.
float spread(std::span<const LensSample> points) {
    glm::vec2 mean(0);
    for (const LensSample& point : points) mean += point.lens / static_cast<float>(points.size());
    float sum = 0;
    for (const LensSample& point : points) sum += glm::dot(point.lens - mean, point.lens - mean);
    return sum / static_cast<float>(points.size());
}

TEST(EvenDivision, orderContainsEachPointOnce) {
    for (const std::uint32_t centres : {0u, 1u, 5u, 36u, 63u, 64u})
        for (const std::uint32_t share : {1u, 2u, 3u, 16u}) {
            const std::uint32_t count = centres * share;
            std::vector<std::uint32_t> order =
                evenDivision(samplesOfLens({}, 0, count), samplesOfLens({}, 0, centres), share);
            ASSERT_EQ(order.size(), count);
            std::ranges::sort(order);
            for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i) << centres << ' ' << share;
        }
}

TEST(EvenDivision, pointsBesideACentreBelongToIt) {
    const std::vector<LensSample> centres = samplesOfLens({}, 0, 16);
    std::vector<LensSample> points;
    for (std::size_t i = 0; i < 64; ++i) {
        points.push_back(centres[i % 16]);
        points.back().lens += 1e-4f * glm::vec2(i % 3, i % 5);
    }
    const std::vector<std::uint32_t> order = evenDivision(points, centres, 4);
    for (std::uint32_t i = 0; i < 64; ++i) EXPECT_EQ(order[i] % 16, i / 4);
}

// Lens points lie near the centre to which they are assigned: their mean squared distance from it is below 0.3 times
// the spread, which is the points' mean squared distance from their common mean. A random assignment would give twice
// the spread. Ideally, the unit disk, whose spread is 1/2, would be divided into sixteen squares of area π/16. The mean
// squared distance of a square's points from its middle is (π/16)/6, or 6.5 % of the spread. The centres of this test
// are random points of the squares, so the ideal distance is twice as large: 13 % of the spread. It is somewhat larger
// for apertures with corners, because points and centres are halved independently.
TEST(EvenDivision, pointsLieNearTheirCentre) {
    for (const ApertureShape& shape : apertureShapes)
        for (const std::uint32_t first : {0u, 64u, 640u}) {
            const std::vector<LensSample> points = samplesOfLens(shape.lens(), first, 64);
            const std::vector<LensSample> centres = samplesOfLens(shape.lens(), first / 4, 16);
            const std::vector<std::uint32_t> order = evenDivision(points, centres, 4);
            float distance = 0;
            for (std::size_t i = 0; i < 64; ++i) {
                const glm::vec2 way = points[order[i]].lens - centres[i / 4].lens;
                distance += glm::dot(way, way) / 64;
            }
            EXPECT_LT(distance, 0.3f * spread(points)) << shape.name << ' ' << first;
        }
}

}  // namespace
}  // namespace defocus::engine
