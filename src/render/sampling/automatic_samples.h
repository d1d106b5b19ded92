#pragma once
// Default number of lens samples of an image. The number follows from the largest blur. For large blurs the number is
// the max, and sampling ends earlier once the estimated error is small.

#include <cstdint>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t minAutomaticSamples = 32;
inline constexpr std::uint32_t maxAutomaticSamples = 1024;
// Target RMSE of the display-encoded image (see StopSettings): half a step of 8 bits.
inline constexpr double automaticError = 0.002;

// Returns the number of samples: 32, or complete blocks of 64 up to 1,024. N points in a disk of c px, the largest blur
// diameter, are approximately c·√(π/(4N)) px apart; N is chosen for a distance of 2 px. With shadow maps, N is at least
// 64; with motion, at least 256. Objects that extend to the near plane have unbounded blur and are ignored.
std::uint32_t samplesForBlur(const FramePlan& plan);

// Returns the largest blur diameter in px of the plan's objects with bounded blur; 0 without such objects.
double largestBoundedBlur(const FramePlan& plan);

}  // namespace defocus::engine
