#pragma once
// Computes focal stacks, all-in-focus images, depths and circles of confusion from lens images (one image per lens
// sample), for depth-from-defocus data sets.

#include <vector>

#include "core/progress.h"
#include "refocus/refocus.h"

namespace defocus::engine {

// Returns one of `count` distances in m that are spaced evenly in 1/distance from `from` to `to`. `i`: index, from 0.
double distanceAt(double from, double to, int i, int count);

// Returns `count` focus distances over a range in m, spaced evenly in 1/distance, the nearest first.
std::vector<double> stackDistances(const FocusRange& range, int count);

// Returns the depths in m of the surfaces that are visible from the lens's centre, +∞ where no surface writes depth.
// The image has one channel and the size of a refocused image, without the margin of lens images.
Image centralDepth(LightField& field);

// Returns the signed diameters in px of the circles of confusion of the surfaces that are visible from the lens's
// centre, > 0 behind the focus plane. The image has one channel and the size of a refocused image, without a margin.
Image centralCoc(LightField& field, const Refocusing& refocusing);

// Returns the image in which everything is in focus, seen from the lens's centre: linear, premultiplied RGBA. Each
// pixel shows one surface. Its colour is the mean over the lens images that show this surface, shifted so that the
// surface is in focus. A lens image counts as showing the surface if its depth there differs from the surface's depth
// by at most one pixel of blur.
Image allInFocus(LightField& field, const Progress& progress = {});

}  // namespace defocus::engine
