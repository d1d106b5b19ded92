#include "render/frame_run.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

void checkStop(const StopSettings& stop, const Method& method, const ShutterSettings& shutter) {
    if (!stop.given()) return;
    const char* what = stop.targetError ? "a target error" : "a time limit";
    if (!method.sumsBlocks)
        throw UsageError(
            fmt::format("method '{}' cannot add lens samples in blocks, which {} requires", method.name, what));
    if (shutter.seconds > 0 && shutter.exactMotion())
        throw UsageError(fmt::format(
            "exact motion cannot be combined with {}, as it needs a fixed number of samples; give a number of motion "
            "segments",
            what));
}

void FrameRun::start(const View& view, const RenderSettings& settings, const StopSettings& stop) {
    begin_ = Clock::now();
    view_ = view;
    before_ = {};
    plan_ = {};
    planMilliseconds_ = 0;
    schedule_.reset();
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

void FrameRun::startAutomatic(RenderSettings settings, const StopSettings& stop) {
    const Quality quality = *stop.automatic;
    settings.sampleCount = blockSamples;
    plan_ = planned(settings);
    const std::uint32_t samples = firstSamples(plan_, quality);
    const bool fourPositions = stop.choosesPositions && fourPositionsSuffice(plan_, samples);
    if (!fourPositions && samples >= blockSamples) {
        schedule_ = BlockSchedule::automatic(settings, quality, samples);
        plan_ = {};
        return startBlock(true);
    }
    settings.sampleCount = samples;
    trial_ = Trial{settings, quality};
    if (fourPositions) {
        settings.positions = 4;
        settings.sampleCount = samples / 4;
    }
    plan_ = planned(settings);
    renderer_->start(plan_);
}

// Measures the error due to levels of detail: renders a few samples at coarse levels, at fine levels and at full
// detail, and compares the images. Returns nullopt with --lod off, and if the measurement takes half of the time limit.
// The cheapest images come first, so that a short limit ends the measurement before it draws full detail.
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

// Draws one wave. A driver queues draws, so the time of a frame is known only after glFinish.
bool FrameRun::advanceRenderer() {
    const bool more = renderer_->advance();
    if (timed_) glFinish();
    return more;
}

bool FrameRun::advance() {
    if (schedule_ && schedule_->stopped()) return false;
    if (advanceRenderer()) {
        if (trial_ && 2 * samples() == plan_.samples.size()) trial_->estimate.add(renderer_->image(), samples());
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

// Ends the trial (FrameRun::Trial). Returns false if the trial's error is small enough. Otherwise starts the frame
// again, in blocks.
bool FrameRun::endTrial() {
    Trial& trial = *trial_;
    if (trial.estimate.samples() == samples()) return false;  // the trial was already assessed
    const bool halved = trial.estimate.samples() > 0;
    if (halved) trial.estimate.add(renderer_->image(), samples());
    const double excess = trial.estimate.flip().value_or(0) / flipOf(trial.quality);
    if (excess <= 1 || blursBeyondSamples(plan_)) return false;
    keepStats();
    const double drawn = static_cast<double>(samples()) * plan_.settings.positions / trial.settings.positions;
    const double expected = drawn * std::pow(excess, 1 / lensSampleExponent);
    schedule_ = BlockSchedule::automatic(trial.settings, trial.quality, expected);
    trial_.reset();
    plan_ = {};
    startBlock(true);
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
    const bool unconfirmed = trial_ ? trial_->estimate.samples() < samples() : schedule_ && schedule_->unconfirmed();
    return (unconfirmed ? 0.5 : 1.0) * samples() / std::max(sampleTotal(), 1u);
}

RenderStats FrameRun::stats() const {
    RenderStats stats = renderer_->stats();
    if (trial_) stats.estimatedError = trial_->estimate.error();
    if (!schedule_) return stats;
    stats.renderMilliseconds += before_.renderMilliseconds;
    stats.setupMilliseconds += before_.setupMilliseconds;
    stats.gpuMilliseconds += before_.gpuMilliseconds;
    stats.cpuTime += before_.cpuTime;
    stats.stopped = schedule_->stopped().value_or(StopReason::sampleCount);
    stats.estimatedError = schedule_->estimatedError();
    return stats;
}

}  // namespace defocus::engine
