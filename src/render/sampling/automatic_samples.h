#pragma once
// Default number of lens samples of an image: derived from the largest blur, and for large blurs from the estimated
// error of the image, which depends on its contrast.

#include <cstdint>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t minAutomaticSamples = 32;
inline constexpr std::uint32_t maxAutomaticSamples = 1024;
// RMSE of the display-encoded image, as in StopSettings: half a step of 8 bits.
inline constexpr double automaticError = 0.002;

// Returns 32 samples, or complete blocks of 64 up to 1,024 samples. N points spread over the disk of the plan's largest
// blur, c px, are about c·√(π/(4N)) px apart; N makes this distance 2 px. Plans with shadow maps get at least 64
// samples, plans with motion at least four blocks. Objects that reach the near plane have unbounded blur and are
// ignored.
std::uint32_t samplesForBlur(const FramePlan& plan);

// Returns the largest blur diameter of the plan's objects, px. Ignores objects with unbounded blur; 0 without others.
double largestBoundedBlur(const FramePlan& plan);

}  // namespace defocus::engine
