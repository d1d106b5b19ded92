#pragma once
// Schedules the blocks of a frame whose number of lens samples is not known in advance. After each block of 64 samples,
// the schedule decides whether another block follows and with which settings. It holds no image and makes no OpenGL
// calls; still images and the window both use it.
//
// The error of levels of detail cannot be estimated from differences between blocks that draw the same levels. It is
// therefore measured before the first block (LevelError). The thresholds that select levels are chosen so that this
// error is less than half the intended error. The intended error is the target error or, if larger, the error predicted
// for the expected number of samples; without a target, it is the predicted error. Without the measurement, the
// thresholds are the defaults for four times the expected number of samples, which select finer levels.

#include <functional>
#include <optional>

#include "plan/frame_plan.h"
#include "render/sampling/error_estimate.h"
#include "render/sampling/stop_settings.h"

namespace defocus::engine {

// Returns a description such as "the estimated error is below the target".
const char* stopReasonText(StopReason reason);

// RMSE that levels of detail cause, as in ErrorEstimate: the difference between images with levels and at full detail,
// for the same few lens samples. The default thresholds that select levels depend on the number of samples for which a
// frame is planned. The RMSE is modelled as a power law in this number, fitted to two measurements.
struct LevelError {
    static constexpr std::uint32_t drawn = 16;    // lens samples drawn for each measurement
    static constexpr std::uint32_t coarse = 128;  // `atCoarse` is measured with levels selected for this many samples
    static constexpr std::uint32_t fine = 2048;   // `atFine` is measured with levels selected for this many samples
    double atCoarse = 0;                          // RMSE with levels selected for 128 samples
    double atFine = 0;                            // RMSE with levels selected for 2,048 samples

    [[nodiscard]] double at(double thresholdSamples) const;
    // Returns the smallest sample count, at least `min`, for which the default level-of-detail thresholds give an RMSE
    // of at most `error`.
    [[nodiscard]] double samplesFor(double error, double min) const;
};

class BlockSchedule {
public:
    BlockSchedule() = default;
    // `settings` are the settings of the frame; their number of samples is ignored. `levels` is nullopt if the error of
    // levels of detail was not measured, or if level of detail is off.
    BlockSchedule(const RenderSettings& settings, const StopSettings& stop, std::optional<LevelError> levels = {});
    // Returns the schedule of a frame with an automatic number of samples. It ends once the estimated FLIP is below the
    // FLIP of `quality`. `expected`: first prediction of the number of samples. Level-of-detail thresholds are the
    // defaults for the expected number of samples.
    static BlockSchedule automatic(const RenderSettings& settings, Quality quality, double expected);

    // Returns the settings of the next block, with its level-of-detail thresholds and its number of samples. The number
    // is limited so that the frame has at most StopSettings::sampleLimit samples.
    [[nodiscard]] RenderSettings nextBlock() const;
    // Returns whether addImage() needs the frame's image after `samples` samples. For an automatic number of samples,
    // the first error estimate after n samples compares the images after n/2 and n samples.
    [[nodiscard]] bool wantsImage(std::uint32_t samples) const;
    void addImage(const Image& mean, std::uint32_t samples) { estimate_.add(mean, samples); }
    // Records that a block has been drawn with `plan`, made from the settings of nextBlock(). Returns whether another
    // block follows. `seconds` is the time since the start of the frame. `mean` returns the frame's current image; it
    // is called only if an error estimate is due.
    bool endBlock(const FramePlan& plan, double seconds, const std::function<Image()>& mean);

    // Returns whether the time limit has passed by more than 0.7 s, the tolerance for finishing a block.
    [[nodiscard]] bool outOfTime(double seconds) const;
    // Ends the frame within a block that has `drawn` complete samples.
    void endWithinBlock(std::uint32_t drawn);

    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // number of samples in complete blocks
    // Returns the predicted final sample count, which is refined after each block.
    [[nodiscard]] std::uint32_t expectedSamples() const;
    [[nodiscard]] std::optional<StopReason> stopped() const { return stopped_; }
    // Returns whether the number of samples is automatic, but so far only predicted from the blur, without an error
    // estimate.
    [[nodiscard]] bool unconfirmed() const { return targetFlip_ && !estimate_.flip(); }
    // Returns the latest error estimate, extrapolated to the current number of samples with lensSampleExponent. A
    // complete frame needs no extrapolation.
    [[nodiscard]] std::optional<double> estimatedError() const;

private:
    [[nodiscard]] std::optional<StopReason> reasonToStop(const FramePlan& plan, double seconds) const;
    [[nodiscard]] double thresholdSamples() const;
    [[nodiscard]] std::optional<double> estimatedFlip() const;
    void predict();
    [[nodiscard]] double withLevels(double sampleError) const;

    RenderSettings settings_;
    StopSettings stop_;
    std::optional<LevelError> levels_;
    std::optional<double> targetFlip_;  // target FLIP for an automatic number of samples
    // Sum over all blocks of the error that levels of detail cause, times the block's number of samples.
    double levelErrorSum_ = 0;
    ErrorEstimate estimate_;  // estimate of the sampling error, without the error of levels of detail
    std::uint32_t samples_ = 0;
    std::uint32_t nextEstimate_ = 0;  // sample count at which the error is estimated next
    double expected_ = 0;             // expected final sample count, not rounded
    double secondsBefore_ = 0;
    std::optional<StopReason> stopped_;
};

}  // namespace defocus::engine
