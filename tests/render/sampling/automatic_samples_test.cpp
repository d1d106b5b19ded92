#include "render/sampling/automatic_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

// With n lens samples, neighbouring images of a point that is blurred over c px are c·√(π/(4n)) px apart. Quality
// "good" allows 4.5 px. 16 samples are therefore enough up to a blur of c = 4.5·√(4·16/π) = 20.3 px.
TEST(FirstSamples, doubleUntilTheyFillABlock) {
    EXPECT_EQ(firstSamples(planOf(0), Quality::good), 16u);
    EXPECT_EQ(firstSamples(planOf(20.3), Quality::good), 16u);
    EXPECT_EQ(firstSamples(planOf(20.4), Quality::good), 32u);
    EXPECT_EQ(firstSamples(planOf(28.8), Quality::good), 64u);
    EXPECT_EQ(firstSamples(planOf(40.7), Quality::good), 128u);
}

TEST(SamplesForBlur, areWholeBlocksWhereTheyAreMoreThanOne) {
    for (const Quality quality : allQualities)
        for (double blur = 1; blur < 200; blur *= 1.1)
            for (const std::uint32_t samples :
                 {samplesForBlur(planOf(blur), quality), firstSamples(planOf(blur), quality)})
                EXPECT_TRUE(samples == 16 || samples == 32 || samples % 64 == 0) << samples;
}

// Higher quality settings aim at smaller errors and begin with at least as many samples. With an error estimate,
// samples can be added later, so the first count is at most the count that is used without an estimate.
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

// Returns a plan of one object with a blur of up to `blur` px. Each sample draws half as many triangles as the image
// has pixels.
FramePlan detailedPlanOf(double blur) {
    FramePlan plan = planOf(blur);
    plan.largestBlur = blur;
    plan.view.width = 640;
    plan.view.height = 480;
    plan.samples.resize(10);
    plan.trianglesDrawn = 10 * 640 * 480 / 2;
    return plan;
}

// With four subpixel positions per sample, a quarter of the samples is enough. The images of a blurred point in
// neighbouring samples are then twice as far apart; up to 1.25 px are allowed.
TEST(FourPositions, sufficeWhereAQuarterOfTheSamplesHasNoGaps) {
    for (const std::uint32_t samples : {16u, 32u, 64u})
        for (double blur = 0.5; blur < 200; blur *= 1.1)
            EXPECT_EQ(fourPositionsSuffice(detailedPlanOf(blur), samples), gapOf(blur, samples / 4) <= 1.25) << blur;
    EXPECT_FALSE(fourPositionsSuffice(detailedPlanOf(std::numeric_limits<double>::infinity()), 32));
}

TEST(FourPositions, doNotReplaceSamplesThatOtherEffectsNeed) {
    const FramePlan plan = detailedPlanOf(1);
    ASSERT_TRUE(fourPositionsSuffice(plan, 32));
    const auto sufficeWith = [&](auto change) {
        FramePlan changed = plan;
        change(changed);
        return fourPositionsSuffice(changed, 32);
    };
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.usesTransmission = true; }));
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.shadows.maps.emplace_back(); }));
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.moments.emplace_back(); }));
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.coc.chromatic = 0.1; }));
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.blendOrder.emplace_back().stochastic = true; }));
    EXPECT_FALSE(sufficeWith([](FramePlan& changed) { changed.usesLens = false; }));
}

TEST(FourPositions, areForManyTrianglesAndImagesOfModerateSize) {
    FramePlan few = detailedPlanOf(1);
    few.trianglesDrawn /= 6;
    EXPECT_FALSE(fourPositionsSuffice(few, 32));
    FramePlan large = detailedPlanOf(1);
    large.view.width = 8192;
    large.view.height = 16;
    EXPECT_FALSE(fourPositionsSuffice(large, 32));
}

TEST(FourPositions, needAQuarterOfTheSamples) {
    const FramePlan plan = detailedPlanOf(1);
    const auto countOf = [&](double samples, std::uint32_t positions, bool chooses) {
        RenderSettings settings{.positions = positions};
        settings = withSamples(settings, plan, samples, chooses);
        return std::pair(settings.sampleCount, settings.positions);
    };
    EXPECT_EQ(countOf(32, 1, false), std::pair(32u, 1u));
    EXPECT_EQ(countOf(33, 1, false), std::pair(64u, 1u));
    EXPECT_EQ(countOf(130, 1, false), std::pair(192u, 1u));
    EXPECT_EQ(countOf(32, 1, true), std::pair(8u, 4u));
    EXPECT_EQ(countOf(33, 1, true), std::pair(16u, 4u));
    EXPECT_EQ(countOf(32, 4, false), std::pair(8u, 4u));
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

// If a point's blur disk has more than 1,024 times the area of the image, fewer than one in 1,024 samples shows the
// point. More samples do not help, so such a blur is ignored.
TEST(SamplesForBlur, leaveOutWhatNoNumberResolves) {
    const FramePlan plan = planOf(0);
    const double pixels = 1.0 * plan.view.width * plan.view.height;
    const double largest = largestSampledBlur(plan);
    EXPECT_NEAR(std::numbers::pi / 4 * largest * largest, 1024 * pixels, 1e-6 * pixels);
    EXPECT_EQ(firstSamples(planOf(0.99 * largest), Quality::good), maxAutomaticSamples);
    EXPECT_EQ(firstSamples(planOf(1.01 * largest), Quality::good), 16u);
}

TEST(SamplesForBlur, followMotion) {
    FramePlan plan = planOf(0);
    plan.moments.resize(1);
    for (const Quality quality : allQualities) EXPECT_EQ(firstSamples(plan, quality), 64u);
}

}  // namespace
}  // namespace defocus::engine
