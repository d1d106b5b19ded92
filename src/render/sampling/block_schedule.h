#pragma once
// Controls a frame whose number of lens samples is open. After each block of samples it decides whether another block
// follows and how that block is planned. It holds no image and calls no GL, so stills and a window's image share it.
//
// Differences between blocks don't reveal the level-of-detail error if all blocks draw the same levels. That error is
// measured beforehand (LevelError). Level-of-detail thresholds then keep it below half of the intended error. The
// intended error is the target, or the error at the expected number of samples. Without the measurement, thresholds are
// those for four times the expected samples.

#include <functional>
#include <optional>

#include "plan/frame_plan.h"
#include "render/sampling/error_estimate.h"
#include "render/sampling/stop_settings.h"

namespace defocus::engine {

// Returns a phrase such as "the estimated error is below the target".
const char* stopReasonText(StopReason reason);

// RMSE between level of detail and full detail in the same few lens samples of a frame, as in ErrorEstimate. It is a
// power law of the sample count whose default thresholds select the levels, fitted to two measurements.
struct LevelError {
    static constexpr std::uint32_t drawn = 16;    // lens samples drawn for each measurement
    static constexpr std::uint32_t coarse = 128;  // sample count whose default thresholds give the coarse levels
    static constexpr std::uint32_t fine = 2048;
    double atCoarse = 0;
    double atFine = 0;

    [[nodiscard]] double at(double thresholdSamples) const;
    // Returns the smallest number of samples, at least `min`, at which the RMSE is at most `error`.
    [[nodiscard]] double samplesFor(double error, double min) const;
};

class BlockSchedule {
public:
    BlockSchedule() = default;
    // `settings`: those of the frame; their number of samples is ignored. `levels`: empty if the level error was not
    // measured or level of detail is off.
    BlockSchedule(const RenderSettings& settings, const StopSettings& stop, std::optional<LevelError> levels = {});
    // Returns the schedule of a frame with an automatic number of samples, up to `max`. Levels are those for `max`
    // samples.
    static BlockSchedule automatic(const RenderSettings& settings, std::uint32_t max);

    // Returns the settings of the next block: its number of samples, clipped to the limit, and its thresholds.
    [[nodiscard]] RenderSettings nextBlock() const;
    // Reports that a block is drawn. `plan`: the block's plan, from nextBlock(). `seconds`: time since the frame began.
    // `mean` returns the frame's current image; it is called only when an estimate is due. Returns false if no other
    // block follows.
    bool endBlock(const FramePlan& plan, double seconds, const std::function<Image()>& mean);

    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // number of samples in the blocks drawn so far
    // Predicted final sample count; refined after each block.
    [[nodiscard]] std::uint32_t expectedSamples() const;
    [[nodiscard]] std::optional<StopReason> stopped() const { return stopped_; }
    // Returns the latest error estimate, extrapolated to the current number of samples by the sequence's exponent. A
    // finished frame has an estimate of its own.
    [[nodiscard]] std::optional<double> estimatedError() const;

private:
    [[nodiscard]] std::optional<StopReason> reasonToStop(const FramePlan& plan, double seconds) const;
    [[nodiscard]] double thresholdSamples() const;
    [[nodiscard]] double withLevels(double sampleError) const;

    RenderSettings settings_;
    StopSettings stop_;
    std::optional<LevelError> levels_;
    bool automatic_ = false;
    double levelErrorSum_ = 0;  // weighted by samples drawn
    ErrorEstimate estimate_;    // sampling error only
    std::uint32_t samples_ = 0;
    std::uint32_t nextEstimate_ = 0;  // sample count at which it is due
    double expected_ = 0;             // samples, not rounded
    double secondsBefore_ = 0;
    std::optional<StopReason> stopped_;
};

}  // namespace defocus::engine
