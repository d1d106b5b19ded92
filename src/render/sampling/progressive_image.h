#pragma once
// Renders the image of an interactive window. While the scene moves, each frame is drawn completely with few samples.
// While nothing moves, blocks of 64 lens samples are added to the same sum. Each block has the level-of-detail
// thresholds for the number of samples in the sum, so levels get finer as the sampling error decreases.

#include <memory>
#include <optional>

#include "render/methods.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

class ProgressiveImage {
public:
    // `world` must outlive this object; the pose of `world` may change between frames. grow() draws options.wave
    // samples together, or 4 if options.wave is 0; a small number helps grow() to stay within its time limit. Needs a
    // current OpenGL context.
    ProgressiveImage(const World& world, const MethodUse& use, const RendererOptions& options);

    // Draws a complete frame, with settings.sampleCount samples (first overload) or the samples of `plan` (second
    // overload).
    void drawFrame(const View& view, const RenderSettings& settings);
    void drawFrame(FramePlan plan);

    // Starts an image that grow() refines up to `max` samples, rounded up to complete blocks of 64. The level-of-detail
    // thresholds of a block are the defaults for the number of samples in the sum after this block.
    //
    // With `targetError`, for methods that sum blocks, the image is complete once its estimated error is below this
    // value. BlockSchedule then chooses the thresholds.
    void begin(const View& view, const RenderSettings& settings, std::uint32_t max,
               std::optional<double> targetError = {});
    // Draws batches (waves) of samples until about `milliseconds` have passed, at least one batch. Returns false once
    // the image is complete.
    bool grow(double milliseconds);

    [[nodiscard]] std::uint32_t samples() const { return renderer_->samples(); }
    [[nodiscard]] bool finished() const { return finished_; }
    // Returns whether the target error is reached; false without a target error.
    [[nodiscard]] bool converged() const;
    // Returns the latest error estimate; nullopt without a target error.
    [[nodiscard]] std::optional<double> estimatedError() const;
    [[nodiscard]] const FramePlan& plan() const { return plan_; }  // plan of the latest frame or block
    [[nodiscard]] const GlTexture* texture() { return renderer_->imageTexture(); }
    [[nodiscard]] RenderStats stats() const { return renderer_->stats(); }

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
    std::optional<BlockSchedule> schedule_;  // schedule of blocks; nullopt without a target error
    bool usesLensSamples_ = true;
    bool sumsBlocks_ = false;
    bool finished_ = true;
};

}  // namespace defocus::engine
