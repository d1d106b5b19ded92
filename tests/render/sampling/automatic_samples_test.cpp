#include "render/sampling/automatic_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace defocus::engine {
namespace {

// Returns a plan of one object with a blur of up to `blur` px.
FramePlan planOf(double blur) {
    FramePlan plan;
    plan.view.nearPlane = 0.1;
    plan.objects.resize(1);
    plan.objects.front().nearestDepth = 1;
    plan.objects.front().coc.largest = blur;
    return plan;
}

TEST(SamplesForBlur, bringNeighboursToTwoPixels) {
    EXPECT_EQ(samplesForBlur(planOf(0)), minAutomaticSamples);
    std::uint32_t before = 0;
    for (double blur = 1; blur < 200; blur *= 1.1) {
        const std::uint32_t samples = samplesForBlur(planOf(blur));
        EXPECT_GE(samples, before);
        before = samples;
        const auto gap = [&](double count) { return blur * std::sqrt(std::numbers::pi / (4 * count)); };
        EXPECT_TRUE(gap(samples) <= 2 || samples == maxAutomaticSamples) << blur;
        EXPECT_TRUE(samples <= 64 || gap(samples - 64) > 2) << "one block fewer must be too few at " << blur;
    }
    EXPECT_EQ(before, maxAutomaticSamples);
}

TEST(SamplesForBlur, areWholeBlocksWhereTheyAreMoreThanOne) {
    for (double blur = 1; blur < 200; blur *= 1.1) {
        const std::uint32_t samples = samplesForBlur(planOf(blur));
        EXPECT_TRUE(samples == 32 || samples % 64 == 0) << samples;
    }
}

TEST(SamplesForBlur, leaveOutWhatHasNoBound) {
    FramePlan plan = planOf(8);
    plan.objects.push_back(plan.objects.front());
    plan.objects.back().nearestDepth = 0;
    plan.objects.back().coc.largest = std::numeric_limits<double>::infinity();
    EXPECT_EQ(samplesForBlur(plan), minAutomaticSamples);
    plan.view.lens.dofEnabled = false;
    EXPECT_EQ(samplesForBlur(plan), minAutomaticSamples);
}

TEST(SamplesForBlur, followMotion) {
    FramePlan plan = planOf(0);
    plan.moments.resize(1);
    EXPECT_EQ(samplesForBlur(plan), 256u);
}

}  // namespace
}  // namespace defocus::engine
