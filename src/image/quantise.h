#pragma once
// Converts display-encoded values to bytes with dithering. Without dithering, the slow gradients of blurred images
// would show bands.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

// Converts values in [0, 1] to bytes, row by row. Values between two multiples of 1/255 are dithered with a fixed
// pattern: interleaved gradient noise (Jimenez 2014, Next Generation Post Processing in Call of Duty: Advanced
// Warfare). Multiples of 1/255 stay exact. Alpha (channel 4) is rounded, not dithered. `firstRow` is the index of the
// first row within the full image; it shifts the pattern.
std::vector<std::uint8_t> quantised(const Image& display, int firstRow = 0);

}  // namespace defocus::engine
