#include "view/state/frame_budget.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace defocus::engine {
namespace {

// Returns the duration in ms of a frame on a machine that takes `perSample` ms for a sample at full resolution.
double cost(const FrameQuality& quality, double perSample) {
    return perSample * quality.samples * quality.resolution * quality.resolution;
}

FrameBudget settled(FrameBudget budget, double perSample) {
    for (int frame = 0; frame < 50; ++frame) budget = adapted(budget, cost(budget.quality(), perSample));
    return budget;
}

TEST(FrameBudget, qualitiesRiseByAboutTwice) {
    const auto qualities = frameQualities();
    for (std::size_t i = 1; i < qualities.size(); ++i) {
        EXPECT_NEAR(cost(qualities[i], 1) / cost(qualities[i - 1], 1), 2, 0.01) << i;
        EXPECT_LE(qualities[i].thresholdBias, qualities[i - 1].thresholdBias);
    }
    // Below half the resolution, outlines would have visible steps.
    EXPECT_GE(qualities.front().resolution, 0.5);
    EXPECT_LE(qualities.front().thresholdBias, 4);
    EXPECT_EQ(qualities.back().resolution, 1);
    EXPECT_EQ(qualities.back().thresholdBias, 1);
}

TEST(FrameBudget, keepsToItsTimeOnAnyMachineThatCan) {
    for (const double perSample : {0.01, 0.1, 0.5, 2.0, 10.0, 50.0})
        for (const double milliseconds : {8.0, 16.0, 66.0}) {
            const FrameBudget budget = settled({milliseconds, 4}, perSample);
            const bool cheapest = budget.rung == 0;
            const bool best = budget.rung == frameQualities().size() - 1;
            const double time = cost(budget.quality(), perSample);
            EXPECT_TRUE(cheapest || time <= 1.15 * milliseconds) << perSample << " " << time;
            EXPECT_TRUE(best || time >= 0.2 * milliseconds) << perSample << " " << time;
        }
}

TEST(FrameBudget, staysWhereItSettled) {
    const FrameBudget budget = settled({16, 0}, 1.3);
    FrameBudget next = budget;
    for (int frame = 0; frame < 20; ++frame) {
        const double noise = frame % 2 == 0 ? 0.95 : 1.05;
        next = adapted(next, noise * cost(next.quality(), 1.3));
        EXPECT_EQ(next.rung, budget.rung) << frame;
    }
}

TEST(FrameBudget, comesDownAtOnce) {
    const std::size_t best = frameQualities().size() - 1;
    const FrameBudget slow = adapted({16, best}, 16 * 16);  // 16 times too slow, which lowers the quality by four steps
    EXPECT_EQ(slow.rung, best - 4);
    EXPECT_EQ(adapted({16, 0}, 1e6).rung, 0u);
    EXPECT_EQ(adapted({16, best}, 0).rung, best);
}

}  // namespace
}  // namespace defocus::engine
