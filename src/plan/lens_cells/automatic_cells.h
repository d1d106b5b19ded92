#pragma once
// Chooses between the two methods that "auto" can use. If enough of the image is strongly blurred, "multirate" is
// chosen, which blurs the image of each lens sample (lens_cells.h). Else "accumulation" is chosen, whose samples cost
// less. The choice depends on the view and the scene, not on the number of samples or the machine. All machines that
// share a frame therefore make the same choice.

#include <string>

namespace defocus::engine {

struct FramePlan;

// Smallest CoC diameter at which gaps between lens samples become visible. With 64 samples, the neighbouring images of
// a point are then 0.9 px apart.
inline constexpr double minBlurOfCells = 8;  // px
// Method "auto" uses lens cells if at least this fraction of the image has a CoC of minBlurOfCells or more.
inline constexpr double minShareOfCells = 0.01;

// Returns the fraction of the image, 0 … 1, in which the CoC diameter is at least `minCoc` px. The fraction is
// estimated from the objects' bounding boxes on a grid of 32 × 24 image positions. Each position shows the nearest box
// that covers it, or else the background. A box is assumed to contain surfaces at all its depths, evenly distributed in
// the logarithm of depth.
double blurredShare(const FramePlan& plan, double minCoc);

// Returns why method "auto" draws the plan by accumulation; empty if it uses lens cells (method "multirate").
std::string reasonForAccumulation(const FramePlan& plan);

}  // namespace defocus::engine
