#pragma once
// How many lens samples a picture asks for, where nobody says: from the largest blur, and where that is wide, from the
// estimated error of the picture itself, which knows the contrast of what is blurred.

#include <cstdint>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t minAutomaticSamples = 32;
inline constexpr std::uint32_t maxAutomaticSamples = 1024;
// RMSE of the display-encoded image, as StopSettings has it: half a step of 8 bits.
inline constexpr double automaticError = 0.002;

// 32, 64 or more whole blocks up to 1,024: N points spread over the disk of the plan's widest blur, c px, lie about
// c·√(π/(4N)) px apart, and the N that brings that to 2 px. What moves while the shutter is open asks for four blocks
// or more. An object that reaches the near plane has no bound to its blur and counts for nothing.
std::uint32_t samplesForBlur(const FramePlan& plan);

// The diameter, px; 0 where nothing has a bound.
double largestBoundedBlur(const FramePlan& plan);

}  // namespace defocus::engine
