#pragma once
// Renders the image of a view, with a fixed number of lens samples or until stop conditions are met:
//   FrameRun run(world, renderer); run.start(view, settings, stop); while (run.advance()) {} renderer.image();
// Without stop conditions, a frame has one plan and one call of Renderer::start. With StopSettings, blocks of 64
// samples are added to one sum until the error or time limit is reached. Each block is planned for the expected final
// number of samples. An automatic number of samples is first predicted from the blur in the plan.

#include <chrono>
#include <optional>

#include "plan/motion/shutter.h"
#include "render/methods.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

// Throws UsageError for a target error or time limit if `method` cannot add blocks of samples (Method::sumsBlocks), or
// if motion needs one pose per sample. With these stop conditions, the number of samples, and thus of poses, is not
// known in advance.
void checkStop(const StopSettings& stop, const Method& method, const ShutterSettings& shutter);

class FrameRun {
public:
    // `world` and `renderer` must outlive this object; `renderer` must have been made for `world`.
    FrameRun(const World& world, Renderer& renderer) : world_(&world), renderer_(&renderer) {}

    // Starts a new frame. `stop` must pass checkStop. If StopSettings::automatic is set, the method must also sum
    // blocks (Method::sumsBlocks), and motion must not need one pose per sample; checkStop does not check this. With a
    // time limit, a GL context must be current.
    void start(const View& view, const RenderSettings& settings, const StopSettings& stop);
    // Draws one wave, a batch of lens samples. Returns false once the frame is complete.
    bool advance();

    [[nodiscard]] std::uint32_t samples() const { return renderer_->samples(); }
    // Returns the final number of samples of the frame. With StopSettings, this is an estimate that is updated after
    // each block.
    [[nodiscard]] std::uint32_t sampleTotal() const;
    // Returns the finished fraction of the work, 0 … 1. While an automatic number of samples is not yet confirmed by an
    // error estimate, the fraction is at most one half.
    [[nodiscard]] double share() const;
    // Returns the plan of the frame. With StopSettings, it is the plan of the latest block of samples, but its triangle
    // counts are sums over all blocks.
    [[nodiscard]] const FramePlan& plan() const { return plan_; }
    // Returns the wall-clock time of planning, summed over all blocks started.
    [[nodiscard]] double planMilliseconds() const { return planMilliseconds_; }
    // Returns the frame's Renderer::stats(), summed over all blocks.
    [[nodiscard]] RenderStats stats() const;

private:
    FramePlan planned(const RenderSettings& settings);
    std::optional<LevelError> measuredLevels(const RenderSettings& settings, const StopSettings& stop);
    bool advanceRenderer();
    void startAutomatic(const RenderSettings& settings, const StopSettings& stop);
    void startAbout(double samples);
    void startBlock(bool first);
    bool endTrial();
    void keepStats();

    const World* world_;
    Renderer* renderer_;
    View view_;
    std::optional<BlockSchedule> schedule_;  // nullopt: the frame has a single plan
    struct Automatic {
        RenderSettings settings;
        Quality quality;
        bool choosesPositions;
    };
    std::optional<Automatic> automatic_;  // nullopt: the number of samples is not automatic
    // Estimates the error of a trial: a complete frame whose automatic number of samples is smaller than a block of 64.
    // If the error exceeds the limit of the quality setting, the frame is drawn again with more samples. nullopt: the
    // frame is not a trial.
    std::optional<ErrorEstimate> trial_;
    FramePlan plan_;
    double planMilliseconds_ = 0;
    RenderStats before_;  // statistics of all blocks before the latest, summed
    bool timed_ = false;  // the frame has a time limit
    std::chrono::steady_clock::time_point blockBegin_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace defocus::engine
