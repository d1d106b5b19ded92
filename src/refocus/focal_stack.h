#pragma once
// Computes focal stacks, all-in-focus pictures, depths and circles of confusion from lens images, for
// depth-from-defocus data sets.

#include <vector>

#include "core/progress.h"
#include "refocus/refocus.h"

namespace defocus::engine {

// Returns distance `i` of `count` from `from` to `to` in m, evenly in 1/distance.
double distanceAt(double from, double to, int i, int count);

// Returns `count` focus distances over a range in m, evenly in 1/distance, the nearest first.
std::vector<double> stackDistances(const FocusRange& range, int count);

// Returns the depths in m of the surfaces that the lens's centre sees, one channel, without the margin; +∞ where no
// surface writes depth.
Image centralDepth(LightField& field);

// Returns the signed diameters in px of the circles of confusion of these surfaces, > 0 behind the focus plane: one
// channel, without the margin.
Image centralCoc(LightField& field, const Refocusing& refocusing);

// Returns the picture in which everything is in focus, as the lens's centre sees it: linear, premultiplied RGBA. Each
// pixel is the mean over the lens images that show its surface, each at the position to which a focus on the surface
// moves it. An image shows the surface if its depth there differs by at most one pixel of blur.
Image allInFocus(LightField& field, const Progress& progress = {});

}  // namespace defocus::engine
