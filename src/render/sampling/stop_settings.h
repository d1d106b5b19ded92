#pragma once
// When a frame has enough lens samples, if their number isn't fixed beforehand.

#include <cstdint>
#include <optional>

#include "defocus/settings.h"

namespace defocus::engine {

// With a target error or a time limit, blocks of 64 samples are added until one of them is reached. Levels of detail
// get finer with the expected number of samples. RenderSettings::sampleCount then counts for nothing.
struct StopSettings {
    // RMSE of the display-encoded image at EV 0, estimated from the differences between blocks; 1e-6 … 1.
    std::optional<double> targetError = {};
    // s from the start of the frame, 0.001 … 1e6. At least one block is drawn, and no block begins that would end
    // later.
    std::optional<double> timeLimit = {};
    std::uint32_t sampleLimit = maxSamples;
    // The number of samples follows from the blur, and for wide blurs from the estimated error; see
    // automatic_samples.h.
    bool automatic = false;

    // Whether a target error or a time limit decides.
    [[nodiscard]] bool given() const { return targetError || timeLimit; }
};

}  // namespace defocus::engine
