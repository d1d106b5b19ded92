#pragma once
// Conditions that end the rendering of a frame whose number of lens samples is not known in advance.

#include <cstdint>
#include <optional>

#include "defocus/settings.h"

namespace defocus::engine {

// With a target error or a time limit, blocks of 64 samples are added until the target or a limit is reached, and
// RenderSettings::sampleCount is ignored. Levels of detail are finer for a larger expected number of samples.
struct StopSettings {
    // Target RMSE of the display-encoded image at EV 0, 1e-6 … 1. The error is estimated from differences between
    // blocks of samples.
    std::optional<double> targetError = {};
    // Seconds from the start of the frame, 0.001 … 1e6. A block is not started if its predicted end is after the limit.
    // A block that takes longer than predicted is stopped 0.7 s after the limit; at least one sample is drawn.
    std::optional<double> timeLimit = {};
    std::uint32_t sampleLimit = maxSamples;
    // If set, the number of samples is chosen automatically; see automatic_samples.h.
    std::optional<Quality> automatic = {};
    // If true, the number of pixel positions per sample (RenderSettings::positions) is also chosen automatically.
    bool choosesPositions = false;

    // Returns whether a target error or a time limit is set.
    [[nodiscard]] bool given() const { return targetError || timeLimit; }
};

}  // namespace defocus::engine
