#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "lens/aperture.h"
#include "lens/lens_samples.h"

namespace defocus::engine {
namespace {

TEST(Sequences, radicalInverseOfTheFirstIntegers) {
    const double base2[] = {0, 0.5, 0.25, 0.75, 0.125};
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(radicalInverse(2, i), base2[i]);
    EXPECT_NEAR(radicalInverse(3, 5), 2.0 / 3 + 1.0 / 9, 1e-15);  // 5 is 12 in base 3, and its mirrored digits are 0.21
}

TEST(Sequences, haltonIsTheRadicalInverseMovedToTheMiddle) {
    for (std::uint64_t i = 0; i < 100; ++i) {
        const SequencePoint point = sequencePoint(Sequence::halton, i, 0);
        const double expected = radicalInverse(3, i + 1) - 1.0 / 3 + 0.5;
        EXPECT_NEAR(point.lens.y, expected - std::floor(expected), 1e-12);
        EXPECT_NEAR(point.lens.x, radicalInverse(2, i + 1), 1e-12);
    }
}

TEST(Sequences, firstPointIsTheMiddle) {
    for (const Sequence sequence : allSequences) {
        const SequencePoint point = sequencePoint(sequence, 0, 0);
        for (const double value : {point.lens.x, point.lens.y, point.pixel.x, point.pixel.y, point.time, point.band})
            EXPECT_NEAR(value, 0.5, 1e-9) << sequenceName(sequence);
    }
}

// ---- prefixes and suffixes of the sequences -------------------------------------------------------------------------

// A region of the unit square, with its area and a test for points inside.
struct Region {
    double area = 0;
    std::function<bool(const glm::dvec2&)> holds;
};

// Returns regions that map to half planes of the lens disk, which are the parts that a blurred straight edge hides.
std::vector<Region> halfPlanes() {
    std::vector<Region> regions;
    for (int direction = 0; direction < 16; ++direction) {
        const double angle = 2 * std::numbers::pi * (direction + 0.3) / 16;
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        for (const double h : {-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75})
            regions.push_back({(std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi,
                               [=](const glm::dvec2& p) { return glm::dot(concentricDisk(p), normal) > h; }});
    }
    return regions;
}

// Returns boxes at a corner of the unit square. They stand for the part of a pixel that an object in focus covers.
std::vector<Region> boxes() {
    std::vector<Region> regions;
    for (int x = 1; x <= 8; ++x)
        for (int y = 1; y <= 8; ++y)
            regions.push_back({x * y / 64.0, [=](const glm::dvec2& p) { return p.x < x / 8.0 && p.y < y / 8.0; }});
    return regions;
}

// Compares the fraction of the first n ≥ 16 points in a region with the region's area. Returns the largest error times
// n/log²n, over all regions and all n.
double worstPrefix(const std::vector<glm::dvec2>& points, const std::vector<Region>& regions) {
    double worst = 0;
    for (const Region& region : regions) {
        double inside = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            inside += region.holds(points[i]) ? 1 : 0;
            const double n = static_cast<double>(i + 1);
            if (n >= 16) worst = std::max(worst, std::abs(inside - n * region.area) / std::pow(std::log(n), 2));
        }
    }
    return worst;
}

double worstPrefixOrSuffix(std::vector<glm::dvec2> points, const std::vector<Region>& regions) {
    const double prefix = worstPrefix(points, regions);
    std::reverse(points.begin(), points.end());
    return std::max(prefix, worstPrefix(points, regions));
}

std::vector<glm::dvec2> pointsOf(Sequence sequence, std::uint32_t count, std::uint32_t seed, bool ofLens) {
    std::vector<glm::dvec2> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const SequencePoint point = sequencePoint(sequence, i, seed);
        points.push_back(ofLens ? point.lens : point.pixel);
    }
    return points;
}

// Coefficient c of the error bound c·log²n/n for n points of a low-discrepancy sequence (Niederreiter 1992).
// Independent points have an error of about n^(−1/2), which exceeds the bound for large n.
constexpr double maxError = 0.5;

TEST(Sequences, everyPrefixAndSuffixCoversLensAndPixel) {
    for (const bool ofLens : {true, false}) {
        const std::vector<Region> regions = ofLens ? halfPlanes() : boxes();
        for (const Sequence sequence : allSequences)
            for (const std::uint32_t seed : {0u, 1u, 2u})
                for (const std::uint32_t count : {64u, 128u, 200u, 1024u})
                    EXPECT_LT(worstPrefixOrSuffix(pointsOf(sequence, count, seed, ofLens), regions), maxError)
                        << sequenceName(sequence) << ", " << count << " points, seed " << seed;
    }
}

// The error of the points with even indices exceeds the bound for complete sequences; so does the error of independent
// points.
TEST(Sequences, boundsFailForParityAndForIndependentPoints) {
    const std::vector<Region> regions = halfPlanes();
    for (const Sequence sequence : {Sequence::halton, Sequence::scrambledHalton, Sequence::sobol}) {
        std::vector<glm::dvec2> even;
        for (std::uint32_t i = 0; i < 128; i += 2) even.push_back(sequencePoint(sequence, i, 0).lens);
        EXPECT_GT(worstPrefixOrSuffix(even, regions), 2 * maxError) << sequenceName(sequence);
    }
    std::vector<glm::dvec2> independent;
    std::uint64_t state = 1;
    const auto next = [&state] {
        // multiplier and increment of Knuth's MMIX generator
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (int i = 0; i < 1024; ++i) independent.emplace_back(next(), next());
    EXPECT_GT(worstPrefixOrSuffix(independent, regions), 1.2 * maxError);
}

double rootMeanSquare(const std::vector<glm::dvec2>& points, const std::vector<Region>& regions) {
    double square = 0;
    for (const Region& region : regions) {
        const auto inside = static_cast<double>(std::count_if(points.begin(), points.end(), region.holds));
        square += std::pow(inside / static_cast<double>(points.size()) - region.area, 2);
    }
    return std::sqrt(square / static_cast<double>(regions.size()));
}

// At 16 to 256 points, seed 0 of `sobol` has a smaller error than Halton and than at least 90 of 100 other Sobol seeds.
TEST(Sequences, seedZeroOfSobolIsAGoodOne) {
    const std::vector<Region> regions = halfPlanes();
    const auto meanLogError = [&](Sequence sequence, std::uint32_t seed) {
        double sum = 0;
        for (const std::uint32_t count : {16u, 32u, 64u, 128u, 256u})
            sum += std::log(rootMeanSquare(pointsOf(sequence, count, seed, true), regions)) / 5;
        return sum;
    };
    const double chosen = meanLogError(Sequence::sobol, 0);
    int better = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) better += meanLogError(Sequence::sobol, seed) < chosen ? 1 : 0;
    EXPECT_LE(better, 10);
    EXPECT_LT(chosen, meanLogError(Sequence::halton, 0) - std::log(1.2));
}

// ---- nets: point sets that fill grid cells evenly -------------------------------------------------------------------

// Returns the min and max number of `points` in a cell of a grid of `columns` × `rows`.
std::pair<int, int> cellCounts(const std::vector<glm::dvec2>& points, int columns, int rows) {
    std::vector<int> counts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (const glm::dvec2& p : points)
        ++counts[static_cast<std::size_t>(p.y * rows) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(p.x * columns)];
    const auto [min, max] = std::minmax_element(counts.begin(), counts.end());
    return {*min, *max};
}

// 2ᵏ Sobol points that start at a multiple of 2ᵏ form a net (Niederreiter 1987): every elementary interval of the lens
// square, of any side ratio, contains one point. Pixel x and y, time and wavelength have one point in each of 2ᵏ equal
// intervals.
TEST(Sequences, alignedBlocksOfSobolAreNets) {
    for (const std::uint32_t seed : {0u, 7u})
        for (const auto& [first, bits] : {std::pair{0u, 4u},
                                          {16u, 4u},
                                          {64u, 6u},
                                          {192u, 6u},
                                          {0u, 10u},
                                          {65'472u, 6u},
                                          {0u, 16u},
                                          {1u << 20, 8u}}) {
            std::vector<glm::dvec2> lens;
            std::vector<glm::dvec2> pixel;
            std::vector<glm::dvec2> rest;
            for (std::uint32_t i = 0; i < 1u << bits; ++i) {
                const SequencePoint point = sequencePoint(Sequence::sobol, first + i, seed);
                lens.push_back(point.lens);
                pixel.push_back(point.pixel);
                rest.emplace_back(point.time, point.band);
            }
            const std::pair once{1, 1};
            for (std::uint32_t x = 0; x <= bits; ++x)
                EXPECT_EQ(cellCounts(lens, 1 << x, 1 << (bits - x)), once) << first << " " << x << " of " << bits;
            for (const auto& points : {pixel, rest}) {
                EXPECT_EQ(cellCounts(points, 1 << bits, 1), once);
                EXPECT_EQ(cellCounts(points, 1, 1 << bits), once);
            }
        }
}

// The pixel coordinates of Sobol points are Joe and Kuo's dimensions 3 and 4. Their quality parameter t is at most 2,
// and at most 1 for 32 or more points. Of n points, 2ᵗ lie in each cell with the area 2ᵗ/n.
TEST(Sequences, pixelOfSobolIsNearlyANet) {
    for (const std::uint32_t seed : {0u, 7u})
        for (const std::uint32_t bits : {5u, 6u, 8u, 10u}) {
            std::vector<glm::dvec2> pixel;
            for (std::uint32_t i = 0; i < 1u << bits; ++i)
                pixel.push_back(sequencePoint(Sequence::sobol, i, seed).pixel);
            for (std::uint32_t x = 0; x <= bits - 1; ++x)
                EXPECT_EQ(cellCounts(pixel, 1 << x, 1 << (bits - 1 - x)), (std::pair{2, 2})) << bits << " " << x;
        }
}

// Scrambling keeps Halton's intervals: on the axis of base b, each interval of length b⁻ᵏ contains one of the first bᵏ
// points.
TEST(Sequences, scramblingHaltonKeepsItsIntervals) {
    for (const std::uint32_t seed : {0u, 5u}) {
        std::array<int, 64> columns{};
        std::array<int, 81> rows{};
        for (std::uint32_t i = 0; i < 81; ++i) {
            const glm::dvec2 point = sequencePoint(Sequence::scrambledHalton, i, seed).lens;
            if (i < 64) ++columns[static_cast<std::size_t>(point.x * 64)];
            ++rows[static_cast<std::size_t>(point.y * 81 + 1e-7)];
        }
        for (const int count : columns) EXPECT_EQ(count, 1);
        for (const int count : rows) EXPECT_EQ(count, 1);
    }
}

TEST(Sequences, longOnesStayPrecise) {
    for (const Sequence sequence : allSequences) {
        constexpr std::uint32_t count = 65'536;
        std::array<double, 6> means{};
        std::vector<double> column;
        for (std::uint32_t i = 0; i < count; ++i) {
            const SequencePoint p = sequencePoint(sequence, i, 0);
            const double values[] = {p.lens.x, p.lens.y, p.pixel.x, p.pixel.y, p.time, p.band};
            for (std::size_t c = 0; c < 6; ++c) means[c] += values[c] / count;
            column.push_back(p.lens.y);
        }
        for (const double mean : means) EXPECT_NEAR(mean, 0.5, 5e-4) << sequenceName(sequence);
        std::sort(column.begin(), column.end());
        double widest = column.front();
        for (std::size_t i = 1; i < column.size(); ++i) {
            EXPECT_NE(column[i], column[i - 1]) << sequenceName(sequence);
            widest = std::max(widest, column[i] - column[i - 1]);
        }
        EXPECT_LT(widest, 4.0 / count) << sequenceName(sequence);
    }
}

// Over many seeds, each point is uniform in the square, so that averages over seeds have no bias. For 1,600 seeds
// counted in 16 cells, χ² with 15 degrees of freedom is below 38 in 999 of 1,000 cases.
TEST(Sequences, seedsSpreadEachPointOverTheSquare) {
    for (const Sequence sequence : allSequences)
        for (const std::uint32_t index : {0u, 1u, 37u}) {
            std::array<double, 16> counts{};
            for (std::uint32_t seed = 1; seed <= 1600; ++seed) {
                const glm::dvec2 p = sequencePoint(sequence, index, seed).lens;
                ++counts[static_cast<std::size_t>(p.x * 4) * 4 + static_cast<std::size_t>(p.y * 4)];
            }
            double square = 0;
            for (const double count : counts) square += (count - 100) * (count - 100) / 100;
            EXPECT_LT(square, 38) << sequenceName(sequence) << " " << index;
        }
}

}  // namespace
}  // namespace defocus::engine
