#pragma once
// Dithered conversion of display-encoded values to bytes. Without dithering, the slow gradients of blurred images would
// show bands.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

// Converts values in [0, 1] to bytes, row by row. Values between two bytes are dithered with a fixed pattern:
// interleaved gradient noise (Jimenez 2014, Next Generation Post Processing in Call of Duty: Advanced Warfare). Values
// equal to a byte stay exact, and alpha (channel 4) is rounded. `firstRow` is the index of the first row within the
// full image.
std::vector<std::uint8_t> quantised(const Image& display, int firstRow = 0);

}  // namespace defocus::engine
