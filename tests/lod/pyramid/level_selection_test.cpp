#include "lod/pyramid/level_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/invariants.h"
#include "special_values.h"

namespace defocus::engine {
namespace {

// Returns a pyramid of five levels with mean edge lengths 1, √2, 2, 2√2 and 4 and errors 0, 0.01, 0.02, 0.04 and 0.08.
Pyramid uniformPyramid() {
    Pyramid pyramid;
    for (int l = 0; l < 5; ++l) {
        PyramidLevel level;
        level.meanEdge = std::pow(2.0, 0.5 * l);
        level.error = l == 0 ? 0 : 0.01 * std::pow(2.0, l - 1);
        pyramid.levels.push_back(level);
    }
    return pyramid;
}

TEST(LevelOfDetail, OfAUniformMeshIsTwiceTheLogarithmOfTargetOverEdge) {
    const Pyramid pyramid = uniformPyramid();
    const double pixelsPerUnit = 3;  // one object unit projects to 3 px
    for (double coc = 0.5; coc < 40; coc *= 1.1) {
        const double target = std::max(0.7 * coc, 1.5);
        const double expected = std::min(std::max(2 * std::log2(target / 3), 0.0), 4.0);
        EXPECT_NEAR(levelOfDetail(pyramid, {pixelsPerUnit, 0, coc}, LodMetric::size, {0.7, 1.5}), expected, 1e-12);
    }
}

// The metric `proportional` depends only on the blur and on the projected bounding box, not on edges or errors.
TEST(LevelOfDetail, isProportionalToTheBlurAndToTheReciprocalOfTheBox) {
    Pyramid pyramid = uniformPyramid();
    const auto lambda = [&](const LevelQuery& query, double factor) {
        return levelOfDetail(pyramid, query, LodMetric::proportional, {.blur = factor});
    };
    for (double coc = 0.5; coc < 40; coc *= 1.1)
        for (const double box : {20.0, 75.0, 300.0})
            EXPECT_NEAR(lambda({1, box, coc}, 10), std::min(10 * coc / box, 4.0), 1e-12);
    const double before = lambda({1, 75, 10}, 10);
    for (PyramidLevel& level : pyramid.levels) level.meanEdge = level.error = 5;
    EXPECT_EQ(lambda({7, 75, 10}, 10), before);
    EXPECT_EQ(lambda({1, 75, 0}, 10), 0) << "without blur, full detail";
    EXPECT_EQ(lambda({0, 0, 0}, 10), 0);
    EXPECT_EQ(lambda({1, 75, 10}, 0), 0);
    EXPECT_EQ(lambda({0, 0, 1}, 10), 4) << "a box that projects to a point";
    EXPECT_EQ(levelOfDetail({}, {1, 75, 10}, LodMetric::proportional, {.blur = 10}), 0);
    pyramid.levels.resize(1);
    EXPECT_EQ(lambda({1, 75, 40}, 10), 0);
}

// If the blur is c px wide and edges of level 0 project to d px, the metric `score` selects the λ whose edges are
// threshold · c/d times as long as those of level 0.
TEST(LevelOfDetail, ByScoreFollowsTheBlurOverTheEdge) {
    const Pyramid pyramid = uniformPyramid();
    for (double coc = 0; coc < 90; coc += 1.3) {
        const double score = coc / 3;
        const double expected = coc > 0 ? std::clamp(2 * std::log2(0.7 * score), 0.0, 4.0) : 0.0;
        EXPECT_NEAR(levelOfDetail(pyramid, {3, 0, coc}, LodMetric::score, {.blur = 0.7}), expected, 1e-12) << coc;
    }
    EXPECT_EQ(chosenThresholds({.blur = 0.3}, LodMetric::score, 64).size, 0);
    EXPECT_EQ(defaultThresholds(LodMetric::score, 64).size, 0);
    EXPECT_EQ(defaultThresholds(LodMetric::score, 256).blur, defaultThresholds(LodMetric::size, 256).blur);
}

TEST(LevelOfDetail, OfErrorsIsLinearBetweenThem) {
    const Pyramid pyramid = uniformPyramid();
    const auto lambda = [&](double target) {
        // at 100 px per unit, the errors of levels 0 … 4 project to 0, 1, 2, 4 and 8 px
        return levelOfDetail(pyramid, {100, 0, 0}, LodMetric::error, {0, target});
    };
    EXPECT_DOUBLE_EQ(lambda(0.25), 0.25);
    EXPECT_DOUBLE_EQ(lambda(1), 1);
    EXPECT_DOUBLE_EQ(lambda(1.5), 1.5);
    EXPECT_DOUBLE_EQ(lambda(3), 2.5);
    EXPECT_DOUBLE_EQ(lambda(5), 3.25);
    EXPECT_DOUBLE_EQ(lambda(8), 4);
    EXPECT_DOUBLE_EQ(lambda(1e9), 4);
}

TEST(LevelOfDetail, IsContinuousAndGrowsWithTheTargetOnPlateaus) {
    Pyramid pyramid = uniformPyramid();
    expectContinuousLevels(pyramid);
    // Edge lengths grow from level 1 to level 2, and errors from level 2 to level 3, by the smallest allowed factor.
    pyramid.levels[2].meanEdge = pyramid.levels[1].meanEdge * 1.05;
    pyramid.levels[3].error = pyramid.levels[2].error * 1.25;
    expectContinuousLevels(pyramid);
}

// The selected real-valued level λ depends only on the target: the allowed edge length or the allowed error, in object
// units. Let levels l and l + 1 have the edge lengths or errors e[l] and e[l+1]. For edges, λ is linear in ln(target)
// between these levels, with the slope 1/ln(e[l+1]/e[l]). For errors, λ is linear in the target, with the slope
// 1/(e[l+1] − e[l]). If the blur, the threshold or the distance changes the target, λ changes by the integral of the
// slope from the old to the new target.
TEST(LevelOfDetail, ChangesAlongEachStretchAsItsFormulaSays) {
    Pyramid pyramid = uniformPyramid();
    pyramid.levels[2].meanEdge = pyramid.levels[1].meanEdge * 1.05;
    pyramid.levels[3].error = pyramid.levels[2].error * 1.25;
    for (const LodMetric metric : {LodMetric::size, LodMetric::error}) {
        const auto stored = [&](std::size_t level) {
            return metric == LodMetric::size ? std::log(pyramid.levels[level].meanEdge) : pyramid.levels[level].error;
        };
        const auto coordinate = [&](double target) { return metric == LodMetric::size ? std::log(target) : target; };
        // Returns by how much the real-valued level λ grows from the target `from` to the target `to`, as the integral
        // of its slope. Targets are edge lengths or errors in object units.
        const auto growth = [&](double from, double to) {
            double sum = 0;
            for (std::size_t l = 0; l + 1 < pyramid.levels.size(); ++l) {
                const double low = std::clamp(coordinate(from), stored(l), stored(l + 1));
                const double high = std::clamp(coordinate(to), stored(l), stored(l + 1));
                sum += (high - low) / (stored(l + 1) - stored(l));
            }
            return sum;
        };
        constexpr double step = 1.003;
        constexpr double unit = 7;  // size in px of an object unit
        for (double target = 1e-3; target < 10; target *= step) {
            const double expected = growth(target, target * step);
            const auto lambda = [&](double pixelsPerUnit, double coc, const LodThresholds& thresholds) {
                return levelOfDetail(pyramid, {pixelsPerUnit, 0, coc}, metric, thresholds);
            };
            const double bySize = lambda(unit, 0, {0, target * step * unit}) - lambda(unit, 0, {0, target * unit});
            const double byBlur =
                lambda(unit, target * step * unit / 0.3, {0.3, 0}) - lambda(unit, target * unit / 0.3, {0.3, 0});
            const double byDistance = lambda(unit / step, 0, {0, target * unit}) - lambda(unit, 0, {0, target * unit});
            ASSERT_NEAR(bySize, expected, 1e-10) << target;
            ASSERT_NEAR(byBlur, expected, 1e-10) << target;
            ASSERT_NEAR(byDistance, expected, 1e-10) << target;
        }
        EXPECT_NEAR(growth(0, 10), 4, 1e-12) << "the sweep passes all levels";
    }
}

TEST(LevelOfDetail, IsZeroWhereNothingCanBeSaid) {
    const Pyramid pyramid = uniformPyramid();
    for (const LodMetric metric : {LodMetric::size, LodMetric::error}) {
        for (const double bad : {double(infinity), -double(infinity), std::nan(""), -1.0})
            EXPECT_EQ(levelOfDetail(pyramid, {bad, 0, 10}, metric, {1, 1}), 0) << bad;
        EXPECT_EQ(levelOfDetail(pyramid, {1, 0, std::nan("")}, metric, {1, 0}), 0);
        EXPECT_EQ(levelOfDetail(pyramid, {1, 0, 10}, metric, {0, 0}), 0) << "thresholds of 0 mean full detail";
        EXPECT_EQ(levelOfDetail(pyramid, {1, 0, 10}, metric, {std::nan(""), std::nan("")}), 0);
        EXPECT_EQ(levelOfDetail(Pyramid{}, {1, 0, 10}, metric, {1, 1}), 0);
        EXPECT_EQ(levelOfDetail(pyramid, {0, 0, 0}, metric, {1, 1}), 4) << "a point uses the coarsest level";
    }
}

TEST(DefaultThresholds, ShrinkSteadilyToNothingAndStayModestForFewSamples) {
    for (const LodMetric metric : {LodMetric::size, LodMetric::error}) {
        const LodThresholds at64 = defaultThresholds(metric, 64);
        LodThresholds last = defaultThresholds(metric, 0);
        EXPECT_DOUBLE_EQ(last.blur, 2 * at64.blur);
        EXPECT_DOUBLE_EQ(last.size, at64.size);
        for (std::uint32_t count = 1; count <= 65'536; count *= 2) {
            const LodThresholds thresholds = defaultThresholds(metric, count);
            EXPECT_LE(thresholds.blur, last.blur);
            EXPECT_LE(thresholds.size, last.size);
            EXPECT_GT(thresholds.blur, 0);
            last = thresholds;
        }
        // the threshold `size` is proportional to (sample count)^(−2/3)
        EXPECT_NEAR(last.size / at64.size, 0.0098, 1e-4);
    }
}

TEST(SplitSamples, SharesSumToAllAndFollowTheFractionByOneSampleAtATime) {
    for (const std::uint32_t count : {1u, 7u, 64u, 1000u}) {
        std::uint32_t last = 0;
        for (std::uint32_t i = 0; i < 4 * count; ++i) {
            const double fraction = i / (4.0 * count);
            const SampleSplit split = splitSamples(2 + fraction, count, LodMode::fractional);
            ASSERT_EQ(split.level, 2u);
            ASSERT_LE(split.coarseCount, count);
            ASSERT_NEAR(split.coarseCount, fraction * count, 0.5 + 1e-9);
            ASSERT_GE(split.coarseCount, last);
            ASSERT_LE(split.coarseCount - last, 1u);
            last = split.coarseCount;
        }
        EXPECT_EQ(last, count) << "just below the next level all samples draw it";
    }
}

// In mode `continuous`, one of the N samples draws both levels: the coarse level in a fraction of the pixels, the fine
// level in the others. For every real-valued level λ, the number of coarse samples plus this fraction is f·N, where f
// is the fractional part of λ.
TEST(SplitSamples, ContinuousSharesAreExactlyTheFraction) {
    for (const std::uint32_t count : {1u, 7u, 64u, 1000u}) {
        for (double lambda = 0; lambda < 5; lambda += 0.00731) {
            const SampleSplit split = splitSamples(lambda, count, LodMode::continuous);
            ASSERT_GE(split.boundaryShare, 0);
            ASSERT_LT(split.boundaryShare, 1);
            ASSERT_LE(split.coarseCount + (split.boundaryShare > 0 ? 1u : 0u), count);
            ASSERT_NEAR(split.level + (split.coarseCount + split.boundaryShare) / count, lambda, 1e-12);
        }
        const SampleSplit full = splitSamples(3, count, LodMode::continuous);
        EXPECT_EQ(full.level, 3u);
        EXPECT_EQ(full.coarseCount, 0u);
        EXPECT_EQ(full.boundaryShare, 0);
        const SampleSplit justBelow = splitSamples(std::nextafter(1.0, 0.0), count, LodMode::continuous);
        EXPECT_LE(justBelow.coarseCount, count);
    }
    EXPECT_EQ(splitSamples(2.3, 64, LodMode::fractional).boundaryShare, 0);
}

TEST(SplitSamples, OtherModesDrawOneLevel) {
    for (double lambda = 0; lambda < 5; lambda += 0.05) {
        const SampleSplit nearest = splitSamples(lambda, 64, LodMode::nearest);
        EXPECT_EQ(nearest.coarseCount, 0u);
        EXPECT_LE(std::abs(nearest.level - lambda), 0.5 + 1e-12);
        const SampleSplit off = splitSamples(lambda, 64, LodMode::off);
        EXPECT_EQ(off.level, 0u);
        EXPECT_EQ(off.coarseCount, 0u);
    }
    EXPECT_EQ(splitSamples(std::nan(""), 64, LodMode::fractional).level, 0u);
    EXPECT_EQ(splitSamples(3, 64, LodMode::fractional).coarseCount, 0u);
}

}  // namespace
}  // namespace defocus::engine
