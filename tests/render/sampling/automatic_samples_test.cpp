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

constexpr Quality allQualities[] = {Quality::draft, Quality::good, Quality::fine};

double gapOf(double blur, double samples) {
    return blur * std::sqrt(std::numbers::pi / (4 * samples));
}

TEST(SamplesForBlur, bringNeighboursToTwoPixels) {
    EXPECT_EQ(samplesForBlur(planOf(0), Quality::good), 32u);
    std::uint32_t before = 0;
    for (double blur = 1; blur < 200; blur *= 1.1) {
        const std::uint32_t samples = samplesForBlur(planOf(blur), Quality::good);
        EXPECT_GE(samples, before);
        before = samples;
        EXPECT_TRUE(gapOf(blur, samples) <= 2 || samples == maxAutomaticSamples) << blur;
        EXPECT_TRUE(samples <= 64 || gapOf(blur, samples - 64) > 2) << "one block fewer must be too few at " << blur;
    }
    EXPECT_EQ(before, maxAutomaticSamples);
}

TEST(SamplesForBlur, areWholeBlocksWhereTheyAreMoreThanOne) {
    for (const Quality quality : allQualities)
        for (double blur = 1; blur < 200; blur *= 1.1)
            for (const std::uint32_t samples :
                 {samplesForBlur(planOf(blur), quality), firstSamples(planOf(blur), quality)})
                EXPECT_TRUE(samples == 16 || samples == 32 || samples % 64 == 0) << samples;
}

// Better qualities aim at smaller errors and begin with at least as many samples. The error estimate can only add
// samples, so the first sample count is at most the count that is used without an estimate.
TEST(SamplesForBlur, followTheQuality) {
    EXPECT_GT(flipOf(Quality::draft), flipOf(Quality::good));
    EXPECT_GT(flipOf(Quality::good), flipOf(Quality::fine));
    for (double blur = 1; blur < 200; blur *= 1.3) {
        std::uint32_t before = 0;
        for (const Quality quality : allQualities) {
            const std::uint32_t first = firstSamples(planOf(blur), quality);
            EXPECT_GE(first, before);
            EXPECT_LE(first, samplesForBlur(planOf(blur), quality));
            before = first;
        }
    }
}

// A quarter of the samples has images of a blurred point that are twice as far apart.
TEST(FourPositions, sufficeWhereAQuarterOfTheSamplesHasNoGaps) {
    for (const std::uint32_t samples : {16u, 32u, 64u})
        for (double blur = 0.5; blur < 200; blur *= 1.1) {
            FramePlan plan = planOf(blur);
            plan.largestBlur = blur;
            EXPECT_EQ(fourPositionsSuffice(plan, samples), gapOf(blur, samples / 4) <= 1.25) << blur;
        }
}

TEST(FourPositions, doNotReplaceSamplesThatOtherEffectsNeed) {
    FramePlan plan = planOf(1);
    ASSERT_TRUE(fourPositionsSuffice(plan, 32));
    FramePlan refracting = plan;
    refracting.usesTransmission = true;
    EXPECT_FALSE(fourPositionsSuffice(refracting, 32));
    FramePlan shadowed = plan;
    shadowed.shadows.maps.emplace_back();
    EXPECT_FALSE(fourPositionsSuffice(shadowed, 32));
    FramePlan moving = plan;
    moving.moments.emplace_back();
    EXPECT_FALSE(fourPositionsSuffice(moving, 32));
    plan.largestBlur = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(fourPositionsSuffice(plan, 32));
}

TEST(SamplesForBlur, leaveOutWhatHasNoBound) {
    FramePlan plan = planOf(8);
    plan.objects.push_back(plan.objects.front());
    plan.objects.back().nearestDepth = 0;
    plan.objects.back().coc.largest = std::numeric_limits<double>::infinity();
    EXPECT_EQ(samplesForBlur(plan, Quality::good), 32u);
    plan.view.lens.dofEnabled = false;
    EXPECT_EQ(samplesForBlur(plan, Quality::good), 32u);
}

// Fewer than one of 1,024 samples shows a point whose blur disk has more than 1,024 times the area of the image, so
// more samples do not help.
TEST(SamplesForBlur, leaveOutWhatNoNumberResolves) {
    const FramePlan plan = planOf(0);
    const double pixels = 1.0 * plan.view.width * plan.view.height;
    const double largest = largestSampledBlur(plan);
    EXPECT_NEAR(std::numbers::pi / 4 * largest * largest, 1024 * pixels, 1e-6 * pixels);
    EXPECT_EQ(firstSamples(planOf(0.99 * largest), Quality::good), maxAutomaticSamples);
    EXPECT_EQ(firstSamples(planOf(1.01 * largest), Quality::good), 32u);
}

TEST(SamplesForBlur, followMotion) {
    FramePlan plan = planOf(0);
    plan.moments.resize(1);
    for (const Quality quality : allQualities) EXPECT_EQ(firstSamples(plan, quality), 64u);
}

}  // namespace
}  // namespace defocus::engine
