#pragma once
// An image that grows for as long as nothing moves: the first block of 64 lens samples, then further blocks, each
// planned for the samples that will then be in the sum (levels get finer as the sampling error falls), all added to one
// sum. Or, while things move, a frame at once from few samples.

#include <memory>
#include <optional>

#include "render/methods.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

class ProgressiveImage {
public:
    // `world` must outlive it; its pose may change between frames. While it grows, options.wave samples are drawn at
    // once (0: 4): small waves end in time. Needs a current GL context.
    ProgressiveImage(const World& world, const MethodUse& use, const RendererOptions& options);

    // A whole frame of settings.sampleCount samples, or as its plan has them.
    void drawFrame(const View& view, const RenderSettings& settings);
    void drawFrame(FramePlan plan);

    // Begins an image that grow() then carries to `most` samples (rounded up to blocks). The level-of-detail thresholds
    // follow the samples that are in the sum after each block.
    // With `targetError`, of methods that sum blocks, the image is finished once its estimated error is below it, and
    // the levels follow the samples that are expected until then (render/block_schedule.h).
    void begin(const View& view, const RenderSettings& settings, std::uint32_t max,
               std::optional<double> targetError = {});
    // Draws waves for about `milliseconds`, at least one. False once the image is finished.
    bool grow(double milliseconds);

    [[nodiscard]] std::uint32_t samples() const { return renderer_->samples(); }
    [[nodiscard]] bool finished() const { return finished_; }
    // With a target error: whether it is reached, and the estimate after the latest block that has one.
    [[nodiscard]] bool converged() const;
    [[nodiscard]] std::optional<double> estimatedError() const;
    [[nodiscard]] const FramePlan& plan() const { return plan_; }  // of the frame or the latest block
    [[nodiscard]] const GlTexture* texture() { return renderer_->imageTexture(); }
    [[nodiscard]] RenderStats stats() const { return renderer_->stats(); }
    [[nodiscard]] double millisecondsPerSample() const { return millisecondsPerSample_; }  // of the latest grow()

private:
    void planBlock();
    bool endBlock();

    const World* world_;
    std::unique_ptr<Renderer> renderer_;
    FramePlan plan_;
    View view_;
    RenderSettings settings_;
    std::uint32_t growingWave_;
    std::uint32_t block_ = 0;
    std::uint32_t blocks_ = 0;
    std::optional<BlockSchedule> schedule_;  // with a target error
    bool usesLensSamples_ = true;
    bool sumsBlocks_ = false;
    bool finished_ = true;
    double millisecondsPerSample_ = 0;
};

}  // namespace defocus::engine
