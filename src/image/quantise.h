#pragma once
// From display-encoded values to bytes, dithered: a slow gradient, as every blur makes many, would show bands.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

// A byte for each value of [0, 1], row by row. What lies between two bytes becomes the one or the other, the nearer
// more often, by a pattern that is the same in every image (interleaved gradient noise: Jimenez 2014, Next Generation
// Post Processing in Call of Duty: Advanced Warfare). A value that is a byte's own stays, and coverage (a fourth
// channel) is rounded. `firstRow`: the number of the first row in the picture that these rows are part of.
std::vector<std::uint8_t> quantised(const Image& display, int firstRow = 0);

}  // namespace defocus::engine
