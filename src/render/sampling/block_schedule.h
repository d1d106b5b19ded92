#pragma once
// A frame whose number of lens samples isn't known beforehand: decides after each block of samples whether another
// comes, and how it is planned. It holds no picture and calls no GL, so that a frame and a window's image share it.
//
// Blocks that draw the same levels don't show the levels' error by differing. It is measured beforehand (LevelError),
// and thresholds of the level of detail are chosen that keep it to half of the error aimed at: the target, or that of
// the samples that are expected. Where it wasn't measured, they follow four times those samples.

#include <functional>
#include <optional>

#include "plan/frame_plan.h"
#include "render/sampling/error_estimate.h"
#include "render/sampling/stop_settings.h"

namespace defocus::engine {

// "the estimated error is below the target"
const char* stopReasonText(StopReason reason);

// RMSE between levels and full detail in the same few lens samples of a frame, as ErrorEstimate has it, by the number
// of samples whose default thresholds choose the levels: a power law through two measurements.
struct LevelError {
    static constexpr std::uint32_t drawn = 16;    // that are drawn for each
    static constexpr std::uint32_t coarse = 128;  // by the defaults for so many samples
    static constexpr std::uint32_t fine = 2048;
    double atCoarse = 0;
    double atFine = 0;

    [[nodiscard]] double at(double thresholdSamples) const;
    // The fewest, `least` or more, at which it is `error` or less.
    [[nodiscard]] double samplesFor(double error, double min) const;
};

class BlockSchedule {
public:
    BlockSchedule() = default;
    // `settings` are the frame's; their number of samples isn't used. `levels`: none where they weren't measured or are
    // not drawn.
    BlockSchedule(const RenderSettings& settings, const StopSettings& stop, std::optional<LevelError> levels = {});
    // Of a frame whose number of samples is automatic, up to `most`: with the levels that as many samples would have.
    static BlockSchedule automatic(const RenderSettings& settings, std::uint32_t max);

    // Those of the block that comes next: its samples, as many as the limit leaves, and its thresholds.
    [[nodiscard]] RenderSettings nextBlock() const;
    // A block is drawn: `plan` is that of nextBlock(), `seconds` the time since the frame began, and `mean` returns the
    // frame's image so far (asked for only where an estimate is due). False when no other block comes.
    bool endBlock(const FramePlan& plan, double seconds, const std::function<Image()>& mean);

    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // of the blocks that are drawn
    // With which the frame is expected to end; it changes as blocks come in.
    [[nodiscard]] std::uint32_t expectedSamples() const;
    [[nodiscard]] std::optional<StopReason> stopped() const { return stopped_; }
    // Of the latest estimate, brought to the present number of samples by the sequence's exponent; that of the finished
    // frame is its own.
    [[nodiscard]] std::optional<double> estimatedError() const;

private:
    [[nodiscard]] std::optional<StopReason> reasonToStop(const FramePlan& plan, double seconds) const;
    [[nodiscard]] double thresholdSamples() const;
    [[nodiscard]] double withLevels(double sampleError) const;

    RenderSettings settings_;
    StopSettings stop_;
    std::optional<LevelError> levels_;
    bool automatic_ = false;
    double levelErrorSum_ = 0;  // over the samples drawn
    ErrorEstimate estimate_;    // of the samples' error alone
    std::uint32_t samples_ = 0;
    std::uint32_t nextEstimate_ = 0;  // samples at which it is due
    double expected_ = 0;             // samples, not rounded
    double secondsBefore_ = 0;
    std::optional<StopReason> stopped_;
};

}  // namespace defocus::engine
