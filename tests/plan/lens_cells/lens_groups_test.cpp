#include "plan/lens_cells/lens_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "aperture_shapes.h"

namespace defocus::engine {
namespace {

std::vector<LensSample> samplesOfLens(const Lens& lens, std::uint32_t first, std::uint32_t count) {
    return lensSamples(lens, Sequence::sobol, first, count, 0);
}

// Returns the first samples of a sequence, one per group.
std::vector<LensSample> imagesOfLens(const Lens& lens, std::uint32_t first, std::uint32_t count, std::uint32_t size) {
    return samplesOfLens(lens, first / size, (count + size - 1) / size);
}

glm::vec2 meanOf(std::span<const LensSample> samples, std::span<const std::uint32_t> members) {
    glm::vec2 sum(0);
    for (const std::uint32_t index : members) sum += samples[index].lens;
    return sum / static_cast<float>(members.size());
}

// Returns the mean square distance from the members' mean.
float spread(std::span<const LensSample> samples, std::span<const std::uint32_t> members) {
    const glm::vec2 mean = meanOf(samples, members);
    float sum = 0;
    for (const std::uint32_t index : members) {
        const glm::vec2 from = samples[index].lens - mean;
        sum += glm::dot(from, from);
    }
    return sum / static_cast<float>(members.size());
}

TEST(LensGroups, eachSampleStandsInTheOrderOnce) {
    for (const std::uint32_t count : {0u, 1u, 5u, 36u, 63u, 64u})
        for (const std::uint32_t size : {1u, 2u, 3u, 4u}) {
            const std::vector<LensSample> samples = samplesOfLens({}, 0, count);
            std::vector<std::uint32_t> order = groupedOrder(samples, imagesOfLens({}, 0, count, size), size);
            ASSERT_EQ(order.size(), count);
            std::ranges::sort(order);
            for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i) << count << ' ' << size;
        }
}

TEST(LensGroups, aPointBesideEachImageIsInItsGroup) {
    std::vector<LensSample> images = samplesOfLens({}, 0, 16);
    std::vector<LensSample> samples;
    for (std::size_t i = 0; i < 64; ++i) {
        samples.push_back(images[i % 16]);
        samples.back().lens += 1e-4f * glm::vec2(i % 3, i % 5);
    }
    const std::vector<std::uint32_t> order = groupedOrder(samples, images, 4);
    for (std::uint32_t i = 0; i < 64; ++i) EXPECT_EQ(order[i] % 16, i / 4);
}

// 16 squares with the disk's area contain 1/16 · (π/6)/(1/2) = 6.5 % of its spread, and random points in one square
// differ by twice that. In apertures with corners, the halves of images and samples differ a little. Unrelated samples
// and images would differ by twice the spread.
TEST(LensGroups, samplesStandWithTheirImage) {
    for (const ApertureShape& shape : apertureShapes)
        for (const std::uint32_t first : {0u, 64u, 640u}) {
            const std::vector<LensSample> samples = samplesOfLens(shape.lens(), first, 64);
            const std::vector<LensSample> images = imagesOfLens(shape.lens(), first, 64, 4);
            const std::vector<std::uint32_t> order = groupedOrder(samples, images, 4);
            float apart = 0;
            for (std::size_t i = 0; i < 64; ++i) {
                const glm::vec2 way = samples[order[i]].lens - images[i / 4].lens;
                apart += glm::dot(way, way) / 64;
            }
            EXPECT_LT(apart, 0.3f * spread(samples, order)) << shape.name << ' ' << first;
        }
}

// A prefix of the groups shares images or draws the coarser level, so it must not cover only one side of the lens.
TEST(LensGroups, prefixesStaySpreadOverTheLens) {
    for (const ApertureShape& shape : apertureShapes) {
        const std::vector<LensSample> samples = samplesOfLens(shape.lens(), 0, 64);
        const std::vector<std::uint32_t> order = groupedOrder(samples, imagesOfLens(shape.lens(), 0, 64, 4), 4);
        const float full = spread(samples, order);
        const glm::vec2 middle = meanOf(samples, order);
        for (const std::size_t groups : {4u, 8u, 12u}) {
            const auto prefix = std::span(order).first(4 * groups);
            EXPECT_GT(spread(samples, prefix), 0.6f * full) << shape.name << ' ' << groups;
            EXPECT_LT(glm::length(meanOf(samples, prefix) - middle), 0.4f * std::sqrt(full)) << shape.name << groups;
        }
    }
}

}  // namespace
}  // namespace defocus::engine
