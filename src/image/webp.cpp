#include "image/webp.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cassert>

#include "image/image_encoding.h"

namespace defocus::engine {

std::vector<unsigned char> encodeWebp(int width, int height, std::span<const unsigned char> rgb, int quality) {
    assert(rgb.size() == std::size_t(width) * std::size_t(height) * 3);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
    spec.attribute("Compression", fmt::format("webp:{}", quality));
    return encode("cannot encode WebP", "webp", spec,
                  [&](OIIO::ImageOutput& output) { return output.write_image(OIIO::TypeUInt8, rgb.data()); });
}

}  // namespace defocus::engine
