#pragma once
// A frame from its view to its image, whether its lens samples are counted beforehand or not:
//   FrameRun run(world, renderer); run.start(view, settings, stop); while (run.advance()) {} renderer.image();
// Without StopSettings it is one plan and Renderer::start; with them, as many blocks as the picture or the time asks
// for, each planned for the samples that are expected, all added to one sum.

#include <chrono>
#include <optional>

#include "plan/motion/shutter.h"
#include "render/methods.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

// Throws UsageError where the settings can't be followed: by a method that doesn't sum blocks (Method::sumsBlocks), or
// with a pose of its own for each of a number of samples that isn't known.
void checkStop(const StopSettings& stop, const Method& method, const ShutterSettings& shutter);

class FrameRun {
public:
    // Both must outlive it; `renderer` was made for `world`.
    FrameRun(const World& world, Renderer& renderer) : world_(&world), renderer_(&renderer) {}

    // Begins a frame, forgetting the one before. checkStop must have passed. An automatic number of samples needs
    // a method that sums blocks, and no exact motion.
    void start(const View& view, const RenderSettings& settings, const StopSettings& stop);
    // Draws one wave of samples; false once the frame is done.
    bool advance();

    [[nodiscard]] std::uint32_t samples() const { return renderer_->samples(); }
    // When the frame is done; with StopSettings an expectation that changes.
    [[nodiscard]] std::uint32_t sampleTotal() const;
    // Of the frame; with StopSettings that of the latest block, whose thresholds and levels are the finest, with the
    // triangles of all blocks.
    [[nodiscard]] const FramePlan& plan() const { return plan_; }
    // Wall clock; of all blocks that were begun.
    [[nodiscard]] double planMilliseconds() const { return planMilliseconds_; }
    // Renderer::stats() of the frame, all blocks together.
    [[nodiscard]] RenderStats stats() const;

private:
    FramePlan planned(const RenderSettings& settings);
    std::optional<LevelError> measuredLevels(RenderSettings settings);
    void startAutomatic(RenderSettings settings);
    void startBlock(bool first);

    const World* world_;
    Renderer* renderer_;
    View view_;
    std::optional<BlockSchedule> schedule_;  // none: one plan
    FramePlan plan_;
    double planMilliseconds_ = 0;
    RenderStats before_;  // of the blocks before the latest: times
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace defocus::engine
