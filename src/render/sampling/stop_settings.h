#pragma once
// Conditions that end a frame whose number of lens samples is open.

#include <cstdint>
#include <optional>

#include "defocus/settings.h"

namespace defocus::engine {

// With a target error or a time limit, blocks of 64 samples are added until one of them is reached. Levels of detail
// get finer with the expected number of samples. RenderSettings::sampleCount is then ignored.
struct StopSettings {
    // RMSE of the display-encoded image at EV 0, estimated from the differences between blocks; 1e-6 … 1.
    std::optional<double> targetError = {};
    // s from the start of the frame, 0.001 … 1e6. At least one block is drawn. No block begins that is predicted to end
    // later.
    std::optional<double> timeLimit = {};
    std::uint32_t sampleLimit = maxSamples;
    // The number of samples follows from the blur, and for large blurs from the estimated error; see
    // automatic_samples.h.
    bool automatic = false;

    // Returns whether a target error or a time limit is set.
    [[nodiscard]] bool given() const { return targetError || timeLimit; }
};

}  // namespace defocus::engine
