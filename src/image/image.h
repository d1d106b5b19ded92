#pragma once
// Defines image types: the float image of the public API, and 8-bit textures.

#include <cstdint>
#include <vector>

#include "defocus/image.h"

namespace defocus::engine {

// Returns width · height in 64 bits.
inline std::uint64_t pixelCount(int width, int height) {
    return std::uint64_t{static_cast<std::uint32_t>(width)} * static_cast<std::uint32_t>(height);
}

// 8-bit RGBA texture as stored in files: encoded values, straight alpha, top row first.
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // width · height · 4 bytes
};

}  // namespace defocus::engine
