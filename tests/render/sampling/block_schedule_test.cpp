// Tests when BlockSchedule ends a frame, and which final sample count it expects when it chooses the settings of a
// block. The images are synthetic and have a known error.

#include "render/sampling/block_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace defocus::engine {
namespace {

// A synthetic frame. After 64 · n samples, the mean image has an error of `first` · n^(−0.6). The steps from each mean
// image to the next are independent.
class MadeFrame {
public:
    explicit MadeFrame(double first) : means_(max) {
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        std::vector<double> value(size, 0.5);
        const auto squared = [&](int n) { return first * first * std::pow(n, -2 * lensSampleExponent); };
        for (int n = max; n >= 1; --n) {
            const double step = n == max ? squared(n) : squared(n) - squared(n + 1);
            for (double& v : value) v += std::sqrt(step) * normal(random);
            means_[static_cast<std::size_t>(n - 1)] = value;
        }
    }

    // Returns the mean image after `samples` samples, converted from the sRGB-encoded values in `means_` to linear
    // values.
    [[nodiscard]] Image mean(std::uint32_t samples) const {
        const std::vector<double>& values = means_[samples / 64 - 1];
        Image image(size / 3, 1, 3);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double encoded = std::clamp(values[i], 0.05, 1.0);
            image.pixels[i] = static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
        }
        return image;
    }

private:
    static constexpr int max = 128;
    static constexpr std::size_t size = 3000;
    std::vector<std::vector<double>> means_;
};

FramePlan planOf(const RenderSettings& settings, std::uint32_t samples) {
    FramePlan plan;
    plan.settings = settings;
    plan.samples.resize(samples);
    return plan;
}

// Renders blocks of samples, each in `seconds` of simulated time, until the schedule ends the frame.
BlockSchedule finished(const MadeFrame& frame, const StopSettings& stop, double seconds = 0) {
    BlockSchedule schedule(RenderSettings{}, stop);
    for (int block = 1;; ++block) {
        const RenderSettings settings = schedule.nextBlock();
        EXPECT_EQ(settings.firstSample, schedule.samples());
        const bool more = schedule.endBlock(planOf(settings, settings.sampleCount), block * seconds,
                                            [&] { return frame.mean(schedule.samples()); });
        if (!more) return schedule;
    }
}

StopSettings targetOf(double error) {
    return {.targetError = error, .timeLimit = {}, .sampleLimit = 8192};
}

TEST(BlockSchedule, endsWhereTheErrorIsTheTarget) {
    const MadeFrame frame(0.02);
    for (const double target : {0.012, 0.006, 0.003, 0.0015}) {
        const BlockSchedule schedule = finished(frame, targetOf(target));
        EXPECT_EQ(schedule.stopped(), StopReason::targetError);
        const double blocks = std::pow(0.02 / target, 1 / lensSampleExponent);
        EXPECT_NEAR(schedule.samples() / 64.0, blocks, 1.5 + 0.1 * blocks) << target;
        EXPECT_LE(schedule.estimatedError().value(), target);
        EXPECT_GT(schedule.estimatedError().value(), 0.7 * target);
    }
}

TEST(BlockSchedule, aPictureThatIsEasyEndsAfterTwoBlocks) {
    const BlockSchedule schedule = finished(MadeFrame(0.001), targetOf(0.01));
    EXPECT_EQ(schedule.samples(), 128u);
    EXPECT_EQ(schedule.stopped(), StopReason::targetError);
}

TEST(BlockSchedule, theLimitEndsItAndCutsTheLastBlock) {
    const MadeFrame frame(0.02);
    StopSettings stop = targetOf(1e-5);
    stop.sampleLimit = 640;
    BlockSchedule schedule = finished(frame, stop);
    EXPECT_EQ(schedule.samples(), 640u);
    EXPECT_EQ(schedule.stopped(), StopReason::sampleCount);
    EXPECT_NEAR(schedule.estimatedError().value(), 0.02 * std::pow(10, -lensSampleExponent), 0.0006);

    stop.sampleLimit = 100;
    schedule = BlockSchedule(RenderSettings{}, stop);
    EXPECT_EQ(schedule.nextBlock().sampleCount, 64u);
    ASSERT_TRUE(schedule.endBlock(planOf(schedule.nextBlock(), 64), 0, [&] { return frame.mean(64); }));
    EXPECT_EQ(schedule.nextBlock().sampleCount, 36u);
    EXPECT_FALSE(schedule.endBlock(planOf(schedule.nextBlock(), 36), 0, [&] { return frame.mean(128); }));
    EXPECT_EQ(schedule.samples(), 100u);
    EXPECT_EQ(schedule.stopped(), StopReason::sampleCount);
}

TEST(BlockSchedule, noBlockIsBegunThatWouldEndTooLate) {
    const MadeFrame frame(0.02);
    StopSettings stop{.targetError = {}, .timeLimit = 10, .sampleLimit = 8192};
    EXPECT_EQ(finished(frame, stop, 3).samples(), 3 * 64u);
    EXPECT_EQ(finished(frame, stop, 30).samples(), 64u);
    stop.timeLimit = 100;
    const BlockSchedule schedule = finished(frame, stop, 3);
    EXPECT_EQ(schedule.samples(), 33 * 64u);
    EXPECT_EQ(schedule.stopped(), StopReason::timeLimit);
    EXPECT_NEAR(schedule.estimatedError().value(), 0.02 * std::pow(33, -lensSampleExponent), 0.0005);
}

TEST(BlockSchedule, aBlockEndsSoonAfterTheTimeLimit) {
    BlockSchedule schedule(RenderSettings{}, {.targetError = {}, .timeLimit = 5, .sampleLimit = 8192});
    EXPECT_FALSE(schedule.outOfTime(5.1));
    EXPECT_TRUE(schedule.outOfTime(5.8));
    schedule.endWithinBlock(7);
    EXPECT_EQ(schedule.samples(), 7u);
    EXPECT_EQ(schedule.expectedSamples(), 7u);
    EXPECT_EQ(schedule.stopped(), StopReason::timeLimit);
    EXPECT_FALSE(BlockSchedule(RenderSettings{}, targetOf(0.01)).outOfTime(1e9));
}

TEST(BlockSchedule, theTargetEndsItBeforeTheTime) {
    StopSettings stop = targetOf(0.01);
    stop.timeLimit = 1000;
    EXPECT_EQ(finished(MadeFrame(0.02), stop, 1).stopped(), StopReason::targetError);
}

TEST(BlockSchedule, antialiasingAloneIsEnoughWhereNothingIsBlurred) {
    BlockSchedule schedule(RenderSettings{}, targetOf(0.001));
    const MadeFrame frame(0.02);
    EXPECT_FALSE(schedule.endBlock(planOf(schedule.nextBlock(), 16), 0, [&] { return frame.mean(64); }));
    EXPECT_EQ(schedule.stopped(), StopReason::nothingBlurred);
    EXPECT_EQ(schedule.samples(), 16u);
    EXPECT_FALSE(schedule.estimatedError());
}

TEST(BlockSchedule, levelsFollowTheSamplesThatAreExpected) {
    const MadeFrame frame(0.02);
    BlockSchedule near(RenderSettings{}, targetOf(0.01));
    BlockSchedule far(RenderSettings{}, targetOf(0.001));
    for (BlockSchedule* schedule : {&near, &far})
        for (int block = 0; block < 2; ++block) {
            const RenderSettings settings = schedule->nextBlock();
            const LodThresholds defaults = defaultThresholds(settings.metric, 4 * schedule->expectedSamples());
            EXPECT_EQ(settings.thresholds.light, defaults.light);
            schedule->endBlock(planOf(settings, 64), 0, [&] { return frame.mean(schedule->samples()); });
        }
    EXPECT_LT(far.nextBlock().thresholds.light, 0.5 * *near.nextBlock().thresholds.light);

    RenderSettings given;
    given.thresholds.size = 2.5;
    EXPECT_EQ(BlockSchedule(given, targetOf(0.01)).nextBlock().thresholds.size, 2.5);
}

TEST(BlockSchedule, measuredLevelsKeepToHalfOfTheTargetAndCountInTheEstimate) {
    const MadeFrame frame(0.02);
    const LevelError levels{.atCoarse = 0.02, .atFine = 0.02 / 16};
    EXPECT_NEAR(levels.at(512), 0.005, 1e-9);
    EXPECT_NEAR(levels.samplesFor(0.005, 128), 512, 52);
    EXPECT_EQ(levels.samplesFor(0.05, 128), 128);
    BlockSchedule schedule(RenderSettings{}, targetOf(0.01), levels);
    for (;;) {
        const RenderSettings settings = schedule.nextBlock();
        EXPECT_LE(*settings.thresholds.light, defaultThresholds(settings.metric, 512).light);
        if (!schedule.endBlock(planOf(settings, 64), 0, [&] { return frame.mean(schedule.samples()); })) break;
    }
    EXPECT_EQ(schedule.stopped(), StopReason::targetError);
    const double samples = 0.02 * std::pow(schedule.samples() / 64.0, -lensSampleExponent);
    EXPECT_NEAR(schedule.estimatedError().value(), std::hypot(samples, 0.0048), 0.0005);
    EXPECT_LE(schedule.estimatedError().value(), 0.01);
}

TEST(BlockSchedule, samplesBeginWhereTheFramesDo) {
    const RenderSettings settings{.firstSample = 4096};
    BlockSchedule schedule(settings, targetOf(0.001));
    EXPECT_EQ(schedule.nextBlock().firstSample, 4096u);
    schedule.endBlock(planOf(schedule.nextBlock(), 64), 0, [&] { return MadeFrame(0.02).mean(64); });
    EXPECT_EQ(schedule.nextBlock().firstSample, 4160u);
}

}  // namespace
}  // namespace defocus::engine
