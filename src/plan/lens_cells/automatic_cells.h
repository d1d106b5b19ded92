#pragma once
// Chooses between the two methods of "auto": lens cells (method "multirate") if a visible part of the image has a large
// blur, else plain accumulation, whose samples cost less. The choice depends on the view and the scene, not on the
// number of samples or the machine. All machines that share a frame therefore make the same choice.

#include <string>

namespace defocus::engine {

struct FramePlan;

// CoC diameter from which gaps between lens samples become visible. With 64 samples, neighbouring images of a point are
// then 0.9 px apart.
inline constexpr double minBlurOfCells = 8;  // px
// Min fraction of the image whose CoC reaches minBlurOfCells, for method "auto" to use lens cells.
inline constexpr double minShareOfCells = 0.01;

// Returns the fraction of the image, 0 … 1, in which the CoC diameter is at least `minCoc` px. The fraction is
// estimated from the objects' bounding boxes on a grid of 32 × 24 image positions. Each position shows the nearest box
// that covers it, or else the background. A box is assumed to contain surfaces at all its depths, evenly distributed in
// the logarithm of depth.
double blurredShare(const FramePlan& plan, double minCoc);

// Returns why method "auto" draws the plan by accumulation; empty if it uses lens cells.
std::string reasonForAccumulation(const FramePlan& plan);

}  // namespace defocus::engine
