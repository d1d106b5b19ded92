#include "render/frame_run.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "plan/render_settings.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

namespace {

// Factor by which a trial (a frame of fewer than 64 samples) overestimates its FLIP error, because few samples leave
// edges rough. The error is estimated from the image of the first half of the samples and the complete image. The value
// is about the middle of the factors measured for ten models: 1.1 to 2.2 with 16 samples where the estimate exceeds
// 0.01, and 1.2 to 1.8 with 32 samples where it exceeds 0.006.
constexpr double excessOfTrial = 1.5;

}  // namespace

void checkStop(const StopSettings& stop, const Method& method, const ShutterSettings& shutter) {
    if (!stop.given()) return;
    const char* what = stop.targetError ? "a target error" : "a time limit";
    if (!method.sumsBlocks)
        throw UsageError(
            fmt::format("method '{}' cannot add lens samples in blocks, which {} requires", method.name, what));
    if (shutter.seconds > 0 && shutter.exactMotion())
        throw UsageError(fmt::format(
            "exact motion needs a fixed number of samples and cannot be combined with {}; give a number of motion "
            "segments instead",
            what));
}

void FrameRun::start(const View& view, const RenderSettings& settings, const StopSettings& stop) {
    begin_ = Clock::now();
    view_ = view;
    before_ = {};
    plan_ = {};
    planMilliseconds_ = 0;
    schedule_.reset();
    automatic_.reset();
    trial_.reset();
    timed_ = stop.timeLimit.has_value();
    if (stop.given()) {
        schedule_.emplace(settings, stop, measuredLevels(settings, stop));
        return startBlock(true);
    }
    if (stop.automatic) return startAutomatic(settings, stop);
    plan_ = planned(settings);
    renderer_->start(plan_);
}

void FrameRun::startAutomatic(const RenderSettings& settings, const StopSettings& stop) {
    automatic_ = {settings, *stop.automatic, stop.choosesPositions};
    automatic_->settings.sampleCount = blockSamples;
    plan_ = planned(automatic_->settings);
    const bool nothingBlurred = plan_.samples.size() < blockSamples;
    startAbout(firstSamples(plan_, automatic_->quality));
    if (nothingBlurred) trial_.reset();  // without blur, the number of samples is fixed, so no error estimate is needed
}

// Starts a frame whose quality is about that of `samples` lens samples with one pixel position each. With more
// positions (RenderSettings::positions), the frame needs fewer samples. 64 or more samples are drawn in blocks of 64.
// Fewer samples are drawn as a trial, a complete frame that is repeated with more samples if its estimated error is too
// large. plan_ must be a plan of the frame, with any number of samples.
void FrameRun::startAbout(double samples) {
    const RenderSettings settings = withSamples(automatic_->settings, plan_, samples, automatic_->choosesPositions);
    if (settings.sampleCount >= blockSamples) {
        const double expected = samples / settings.positions;
        schedule_ = BlockSchedule::automatic(settings, automatic_->quality, expected);
        plan_ = {};
        return startBlock(true);
    }
    trial_.emplace();
    plan_ = planned(settings);
    renderer_->start(plan_);
}

// Measures the error of levels of detail: renders a few samples at coarse levels, at fine levels and at full detail,
// and compares the images. Returns nullopt with --lod off, or if the measurement takes more than half of the time
// limit. The cheapest images come first, so that a short limit ends the measurement before full detail is drawn.
std::optional<LevelError> FrameRun::measuredLevels(const RenderSettings& settings, const StopSettings& stop) {
    if (settings.lod == LodMode::off) return {};
    const auto drawn = [&](const RenderSettings& with) -> std::optional<Image> {
        renderer_->start(planned(with));
        while (advanceRenderer())
            if (stop.timeLimit && millisecondsSince(begin_) > 500 * *stop.timeLimit) return {};
        return renderer_->image();
    };
    const auto withThresholdsFor = [&](std::uint32_t samples) {
        RenderSettings levels = settings;
        levels.sampleCount = LevelError::drawn;
        fixThresholds(levels, samples);
        return levels;
    };
    RenderSettings fullDetail = settings;
    fullDetail.sampleCount = LevelError::drawn;
    fullDetail.lod = LodMode::off;
    const std::optional<Image> atCoarse = drawn(withThresholdsFor(LevelError::coarse));
    const std::optional<Image> atFine = atCoarse ? drawn(withThresholdsFor(LevelError::fine)) : std::nullopt;
    const std::optional<Image> full = atFine ? drawn(fullDetail) : std::nullopt;
    if (!full) return {};
    return LevelError{encodedDifference(*full, *atCoarse), encodedDifference(*full, *atFine)};
}

FramePlan FrameRun::planned(const RenderSettings& settings) {
    const Clock::time_point begin = Clock::now();
    FramePlan plan = planFrame(*world_, view_, settings);
    planMilliseconds_ += millisecondsSince(begin);
    return plan;
}

void FrameRun::startBlock(bool first) {
    blockBegin_ = Clock::now();
    FramePlan plan = planned(schedule_->nextBlock());
    if (first)
        renderer_->start(plan);
    else
        renderer_->continueWith(plan);
    plan.trianglesDrawn += plan_.trianglesDrawn;
    plan.trianglesFacingAway += plan_.trianglesFacingAway;
    plan.trianglesOutside += plan_.trianglesOutside;
    plan.trianglesAtFullDetail += plan_.trianglesAtFullDetail;
    plan_ = std::move(plan);
}

// Draws one batch (wave) of lens samples. With a time limit, waits until the GPU has drawn the batch, because drivers
// only queue draws and the measured time would otherwise be too short.
bool FrameRun::advanceRenderer() {
    const bool more = renderer_->advance();
    if (timed_) glFinish();
    return more;
}

bool FrameRun::advance() {
    if (schedule_ && schedule_->stopped()) return false;
    if (advanceRenderer()) {
        const bool isHalf = 2 * samples() == plan_.samples.size();
        if (trial_ && isHalf) trial_->add(renderer_->image(), samples());
        if (schedule_ && schedule_->wantsImage(samples())) schedule_->addImage(renderer_->image(), samples());
        if (!timed_ || !schedule_->outOfTime(millisecondsSince(begin_) / 1000)) return true;
        schedule_->endWithinBlock(renderer_->samples() - schedule_->samples());
        before_.renderMilliseconds += millisecondsSince(blockBegin_);
        return false;
    }
    if (trial_) return endTrial();
    if (!schedule_) return false;
    const bool more =
        schedule_->endBlock(plan_, millisecondsSince(begin_) / 1000, [this] { return renderer_->image(); });
    if (!more) return false;
    keepStats();
    startBlock(false);
    return true;
}

// Ends the trial, a frame of fewer than 64 samples. Returns false if the trial's error is small enough. Otherwise
// starts the frame again, with more samples.
bool FrameRun::endTrial() {
    const bool assessed = trial_->samples() == samples();
    const bool halved = trial_->samples() > 0;
    if (assessed || !halved) return false;
    trial_->add(renderer_->image(), samples());
    const double excess = trial_->flip().value_or(0) / (excessOfTrial * flipOf(automatic_->quality));
    if (!(excess > 1) || blursBeyondSamples(plan_)) return false;  // the comparison is false for NaN, too
    keepStats();
    trial_.reset();
    startAbout(positionCount(plan_.settings) * std::pow(excess, 1 / lensSampleExponent));
    return true;
}

void FrameRun::keepStats() {
    const RenderStats block = renderer_->stats();
    before_.renderMilliseconds += block.renderMilliseconds;
    before_.setupMilliseconds += block.setupMilliseconds;
    before_.gpuMilliseconds += block.gpuMilliseconds;
    before_.cpuTime += block.cpuTime;
}

std::uint32_t FrameRun::sampleTotal() const {
    return schedule_ ? std::max(schedule_->expectedSamples(), samples()) : renderer_->sampleTotal();
}

double FrameRun::share() const {
    const bool unconfirmed = trial_ ? trial_->samples() < samples() : schedule_ && schedule_->unconfirmed();
    return (unconfirmed ? 0.5 : 1.0) * samples() / std::max(sampleTotal(), 1u);
}

RenderStats FrameRun::stats() const {
    RenderStats stats = renderer_->stats();
    stats.renderMilliseconds += before_.renderMilliseconds;
    stats.setupMilliseconds += before_.setupMilliseconds;
    stats.gpuMilliseconds += before_.gpuMilliseconds;
    stats.cpuTime += before_.cpuTime;
    if (trial_) stats.estimatedError = trial_->error();
    if (!schedule_) return stats;
    stats.stopped = schedule_->stopped().value_or(StopReason::sampleCount);
    stats.estimatedError = schedule_->estimatedError();
    return stats;
}

}  // namespace defocus::engine
