#pragma once
// Computes focal stacks, all-in-focus pictures, depths and circles of confusion from lens images, for
// depth-from-defocus data sets.

#include <vector>

#include "core/progress.h"
#include "refocus/refocus.h"

namespace defocus::engine {

// Returns distance number `i`, counted from 0, of `count` distances in m that are spaced evenly in 1/distance.
double distanceAt(double from, double to, int i, int count);

// Returns `count` focus distances over a range in m, evenly in 1/distance, the nearest first.
std::vector<double> stackDistances(const FocusRange& range, int count);

// Returns the depths in m of the surfaces that are visible from the lens's centre, one channel, without the margin; +∞
// where no surface writes depth.
Image centralDepth(LightField& field);

// Returns the signed diameters in px of the circles of confusion of the surfaces that are visible from the lens's
// centre, > 0 behind the focus plane: one channel, without the margin.
Image centralCoc(LightField& field, const Refocusing& refocusing);

// Returns the picture in which everything is in focus, seen from the lens's centre: linear, premultiplied RGBA. Each
// pixel is the mean over the lens images that show its surface, shifted as for a focus on that surface. An image counts
// as showing the surface if the difference in depth would cause at most one pixel of blur.
Image allInFocus(LightField& field, const Progress& progress = {});

}  // namespace defocus::engine
