#pragma once
// Images: the float image of the public API, and textures as files hold them.

#include <cstdint>
#include <vector>

#include "defocus/image.h"

namespace defocus::engine {

// An 8-bit RGBA texture as a file holds it (encoded values, straight alpha), row 0 at the top.
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // width · height · 4
};

}  // namespace defocus::engine
