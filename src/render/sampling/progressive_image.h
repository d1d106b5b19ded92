#pragma once
// An image that is refined while nothing moves: a first block of 64 lens samples, then further blocks added to the same
// sum. Each block is planned for the samples that the sum will then hold, so levels get finer as the sampling error
// falls. While the scene moves, each frame is drawn at once with few samples.

#include <memory>
#include <optional>

#include "render/methods.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

class ProgressiveImage {
public:
    // `world` must outlive this object; its pose may change between frames. While the image grows, options.wave samples
    // are drawn at once (0: 4), as small waves keep to the time limit. Needs a current GL context.
    ProgressiveImage(const World& world, const MethodUse& use, const RendererOptions& options);

    // Draws a complete frame of settings.sampleCount samples, or with the samples of `plan`.
    void drawFrame(const View& view, const RenderSettings& settings);
    void drawFrame(FramePlan plan);

    // Begins an image that grow() refines to `max` samples (rounded up to blocks). Level-of-detail thresholds follow
    // the samples in the sum after each block.
    //
    // With `targetError`, for methods that sum blocks, the image is finished once its estimated error is below this
    // value. Thresholds then follow the expected final number of samples (sampling/block_schedule.h).
    void begin(const View& view, const RenderSettings& settings, std::uint32_t max,
               std::optional<double> targetError = {});
    // Draws waves for about `milliseconds`, at least one. Returns false once the image is finished.
    bool grow(double milliseconds);

    [[nodiscard]] std::uint32_t samples() const { return renderer_->samples(); }
    [[nodiscard]] bool finished() const { return finished_; }
    // For images with a target error: whether it is reached, and the latest estimate.
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
    std::optional<BlockSchedule> schedule_;  // used only with a target error
    bool usesLensSamples_ = true;
    bool sumsBlocks_ = false;
    bool finished_ = true;
    double millisecondsPerSample_ = 0;
};

}  // namespace defocus::engine
