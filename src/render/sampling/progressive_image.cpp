#include "render/sampling/progressive_image.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

#include "core/stopwatch.h"
#include "plan/render_settings.h"

namespace defocus::engine {

namespace {

// Returns the plan with all levels of drawn meshes marked as used, so that no upload delays a later frame.
FramePlan withAllLevels(FramePlan plan) {
    if (plan.settings.lod != LodMode::off)
        for (std::vector<bool>& used : plan.levelsUsed) used.assign(used.size(), true);
    return plan;
}

}  // namespace

ProgressiveImage::ProgressiveImage(const World& world, const MethodUse& use, const RendererOptions& options)
    : world_(&world),
      growingWave_(options.wave > 0 ? options.wave : 4),
      usesLensSamples_(use.method->usesLensSamples),
      sumsBlocks_(use.method->sumsBlocks) {
    RendererOptions complete = options;
    complete.settings = use.settings;
    renderer_ = use.method->make(world, complete);
}

void ProgressiveImage::drawFrame(const View& view, const RenderSettings& settings) {
    drawFrame(planFrame(*world_, view, settings));
}

void ProgressiveImage::drawFrame(FramePlan plan) {
    plan_ = withAllLevels(std::move(plan));
    finished_ = true;
    renderer_->setWave({.samples = plan_.settings.sampleCount});
    drawAllSamples(*renderer_, plan_);
    glFinish();
}

void ProgressiveImage::begin(const View& view, const RenderSettings& settings, std::uint32_t max,
                             std::optional<double> targetError) {
    view_ = view;
    settings_ = settings;
    settings_.sampleCount = blockSamples;
    block_ = 0;
    blocks_ = std::max(1u, (max + blockSamples - 1) / blockSamples);
    schedule_.reset();
    if (targetError && sumsBlocks_)
        schedule_.emplace(
            settings, StopSettings{.targetError = targetError, .timeLimit = {}, .sampleLimit = blocks_ * blockSamples});
    planBlock();
    renderer_->setWave({.samples = growingWave_});
    renderer_->start(plan_);
    finished_ = false;
}

void ProgressiveImage::planBlock() {
    if (schedule_) {
        plan_ = withAllLevels(planFrame(*world_, view_, schedule_->nextBlock()));
        return;
    }
    RenderSettings settings = settings_;
    settings.firstSample += block_ * blockSamples;
    fixThresholds(settings, (block_ + 1) * blockSamples);
    plan_ = withAllLevels(planFrame(*world_, view_, settings));
}

// Ends the current block of samples and returns whether another block follows.
bool ProgressiveImage::endBlock() {
    ++block_;
    if (schedule_) return schedule_->endBlock(plan_, 0, [this] { return renderer_->image(); });
    // No block follows if nothing is blurred, so that the plan has fewer than 64 samples, or if the method uses no lens
    // samples.
    return block_ < blocks_ && usesLensSamples_ && plan_.samples.size() >= blockSamples;
}

bool ProgressiveImage::converged() const {
    return schedule_ && schedule_->stopped() == StopReason::targetError;
}

std::optional<double> ProgressiveImage::estimatedError() const {
    return schedule_ ? schedule_->estimatedError() : std::nullopt;
}

bool ProgressiveImage::grow(double milliseconds) {
    const Clock::time_point begin = Clock::now();
    while (!finished_) {
        const Clock::time_point waveBegin = Clock::now();
        if (renderer_->samples() == renderer_->sampleTotal()) {
            finished_ = !endBlock();
            if (finished_) break;
            planBlock();
            renderer_->continueWith(plan_);
        }
        renderer_->advance();
        glFinish();
        if (millisecondsSince(begin) + millisecondsSince(waveBegin) > milliseconds) break;
    }
    return !finished_;
}

}  // namespace defocus::engine
