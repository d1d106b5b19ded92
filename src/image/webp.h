#pragma once
// Encodes 8-bit images as WebP.

#include <span>
#include <vector>

namespace defocus::engine {

// Returns an RGB image (3 bytes per pixel, top row first) as lossy WebP of quality 1 … 100. Throws Error if the image
// library cannot write WebP, and for sides above 16383 px.
std::vector<unsigned char> encodeWebp(int width, int height, std::span<const unsigned char> rgb, int quality);

}  // namespace defocus::engine
