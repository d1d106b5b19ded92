#include "render/sampling/block_schedule.h"

#include <algorithm>
#include <cmath>

#include "plan/render_settings.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

namespace {

// Max error of levels of detail, relative to the intended error. The total error is then at most √(1 + 0.5²) = 1.12
// times the intended error.
constexpr double levelShare = 0.5;
// If the error of levels of detail was not measured, levels are selected as for this multiple of the expected number of
// samples. A larger number of samples gives finer levels, and thus a smaller error.
constexpr double withoutLevelError = 4;
constexpr double blockTolerance = 0.7;  // seconds after the time limit at which an unfinished block is stopped
constexpr double maxThresholdSamples = 1e8;
constexpr double maxLevelPower = 1.4;
// Sample count of the first error estimate, which needs two blocks.
constexpr std::uint32_t firstEstimate = 2 * blockSamples;
// An error estimate after one block compares the image of the first half of the block with the image of the whole
// block. It is too large by this factor, for two reasons. The first half draws coarse levels more often than the second
// half. The lens cells of the first half's samples (one part of the lens each) are not centred on the lens, which
// shifts blurred surfaces. Measured factors: 1.3 (school of fish) and 2.0 (bokeh). The smaller one is used so that the
// error is not underestimated.
constexpr double excessWithinBlock = 1.3;

// Returns `samples` rounded up to complete blocks.
std::uint32_t completeBlocks(double samples) {
    return static_cast<std::uint32_t>(std::ceil(samples / blockSamples)) * blockSamples;
}

}  // namespace

const char* stopReasonText(StopReason reason) {
    switch (reason) {
        case StopReason::sampleCount:
            return "all requested samples are drawn";
        case StopReason::targetError:
            return "the estimated error is below the target";
        case StopReason::timeLimit:
            return "the time limit is reached";
        case StopReason::nothingBlurred:
            return "nothing is blurred";
    }
    return "";
}

double LevelError::at(double thresholdSamples) const {
    if (!(atCoarse > 0)) return 0;
    // If the user sets the level-of-detail thresholds, both errors were measured with the same levels. Then atCoarse
    // equals atFine, and the exponent is 0.
    const double measured = std::log(atCoarse / std::max(atFine, 1e-9)) / std::log(double{fine} / coarse);
    return atCoarse * std::pow(coarse / thresholdSamples, std::clamp(measured, 0.0, maxLevelPower));
}

double LevelError::samplesFor(double error, double min) const {
    double samples = min;
    while (at(samples) > error && samples < maxThresholdSamples) samples *= 1.1;
    return samples;
}

BlockSchedule::BlockSchedule(const RenderSettings& settings, const StopSettings& stop, std::optional<LevelError> levels)
    : settings_(settings), stop_(stop), levels_(levels), nextEstimate_(blockSamples), expected_(firstEstimate) {}

BlockSchedule BlockSchedule::automatic(const RenderSettings& settings, Quality quality, double expected) {
    BlockSchedule schedule(
        settings, {.targetError = {}, .timeLimit = {}, .sampleLimit = maxAutomaticSamples / settings.positions});
    schedule.targetFlip_ = flipOf(quality);
    schedule.expected_ = expected;
    const double first = 0.5 * std::min<double>(expected, schedule.stop_.sampleLimit);
    const std::uint32_t blocks = completeBlocks(first) / blockSamples;
    schedule.nextEstimate_ = (blocks == 1 ? 1 : blocks / 2 * 2) * blockSamples;
    return schedule;
}

bool BlockSchedule::wantsImage(std::uint32_t samples) const {
    return targetFlip_ && estimate_.samples() == 0 && samples == nextEstimate_ / 2;
}

std::uint32_t BlockSchedule::expectedSamples() const {
    if (stopped_) return samples_;
    const auto max = static_cast<double>(stop_.sampleLimit);
    return std::min(stop_.sampleLimit, completeBlocks(std::clamp(expected_, std::min(samples_ + 1.0, max), max)));
}

// Returns the sample count for which the next block's level-of-detail thresholds are chosen. A larger count gives finer
// levels.
double BlockSchedule::thresholdSamples() const {
    const double expected = expectedSamples();
    if (targetFlip_) return expected;
    const std::optional<double> now = estimate_.error();
    std::optional<double> aim = stop_.targetError;
    if (now) aim = std::max(aim.value_or(0), *now * std::pow(estimate_.samples() / expected, lensSampleExponent));
    if (!levels_ || !aim) return withoutLevelError * expected;
    return levels_->samplesFor(levelShare * *aim, expected);
}

// Returns the total error: the sampling error `sampleError` combined with the mean error of levels of detail in the
// blocks so far. The two errors are assumed to be independent.
double BlockSchedule::withLevels(double sampleError) const {
    return std::hypot(sampleError, levelErrorSum_ / std::max(samples_, 1u));
}

RenderSettings BlockSchedule::nextBlock() const {
    RenderSettings settings = settings_;
    settings.firstSample += samples_;
    settings.sampleCount = std::min(blockSamples, stop_.sampleLimit - samples_);
    fixThresholds(settings, static_cast<std::uint32_t>(thresholdSamples() * settings.positions));
    return settings;
}

std::optional<double> BlockSchedule::estimatedError() const {
    if (!estimate_.error() || samples_ == 0) return {};
    return withLevels(*estimate_.error() *
                      std::pow(static_cast<double>(estimate_.samples()) / samples_, lensSampleExponent));
}

std::optional<double> BlockSchedule::estimatedFlip() const {
    const std::optional<double> flip = estimate_.flip();
    return flip && estimate_.samples() == blockSamples ? *flip / excessWithinBlock : flip;
}

// Predicts the final number of samples from the latest error estimate, and chooses the number of samples at which the
// error is estimated next.
void BlockSchedule::predict() {
    if (targetFlip_) {
        if (const double flip = estimatedFlip().value_or(0); flip > 0)
            expected_ = samples_ * std::pow(flip / *targetFlip_, 1 / lensSampleExponent);
    } else if (const double error = estimate_.error().value_or(0); stop_.targetError && error > 0) {
        // The squares of the sampling error and of the error of levels of detail sum to the square of the target. The
        // error of levels is clamped to 90 % of the target, so that at least √(1 − 0.9²) = 44 % is left for the
        // sampling error.
        const double levels = std::min(withLevels(0), 0.9 * *stop_.targetError);
        const double aim = std::sqrt(*stop_.targetError * *stop_.targetError - levels * levels);
        expected_ = samples_ * std::pow(error / aim, 1 / lensSampleExponent);
    }
    // The next estimate is due at 80 % of the expected final number of samples, but at the latest at twice the current
    // number n: an estimate after 2n samples needs the image after about n samples, which has just been stored.
    const bool aims = targetFlip_ || stop_.targetError;
    const double due = aims ? std::clamp(0.8 * expected_, samples_ + 1.0, 2.0 * samples_) : 2.0 * samples_;
    nextEstimate_ = completeBlocks(due);
}

bool BlockSchedule::endBlock(const FramePlan& plan, double seconds, const std::function<Image()>& mean) {
    const auto drawn = static_cast<std::uint32_t>(plan.samples.size());
    if (levels_) levelErrorSum_ += drawn * levels_->at(thresholdSamples());
    samples_ += drawn;

    if (wantsImage(samples_)) addImage(mean(), samples_);
    if (samples_ >= nextEstimate_) {
        estimate_.add(mean(), samples_);
        predict();
    }
    if (stop_.timeLimit && seconds > 0) {
        const double inTime = samples_ * *stop_.timeLimit / seconds;
        expected_ = stop_.targetError && samples_ >= firstEstimate ? std::min(expected_, inTime) : inTime;
    }

    stopped_ = reasonToStop(plan, seconds);
    secondsBefore_ = seconds;
    if (stopped_ && estimate_.samples() < samples_) estimate_.add(mean(), samples_);
    return !stopped_;
}

bool BlockSchedule::outOfTime(double seconds) const {
    return stop_.timeLimit && seconds > *stop_.timeLimit + blockTolerance;
}

void BlockSchedule::endWithinBlock(std::uint32_t drawn) {
    samples_ += drawn;
    stopped_ = StopReason::timeLimit;
}

std::optional<StopReason> BlockSchedule::reasonToStop(const FramePlan& plan, double seconds) const {
    const std::uint32_t asked = plan.settings.sampleCount;
    if (plan.samples.size() < asked) return StopReason::nothingBlurred;
    const bool estimated = estimate_.samples() == samples_ && estimate_.error();
    if (stop_.targetError && estimated && withLevels(*estimate_.error()) <= *stop_.targetError)
        return StopReason::targetError;
    if (targetFlip_ && estimated && *estimatedFlip() <= *targetFlip_) return StopReason::targetError;
    if (samples_ >= stop_.sampleLimit) return StopReason::sampleCount;
    // Do not start a block that would end after the time limit: an incomplete block would lack samples at one of the
    // two levels that it draws of some objects.
    const double nextEnd = seconds + (seconds - secondsBefore_);
    if (stop_.timeLimit && nextEnd > *stop_.timeLimit) return StopReason::timeLimit;
    return {};
}

}  // namespace defocus::engine
