#include "image/webp.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cassert>
#include <memory>

#include "core/error.h"
#include "image/oiio_names.h"

namespace defocus::engine {

std::vector<unsigned char> encodeWebp(int width, int height, std::span<const unsigned char> rgb, int quality) {
    assert(rgb.size() == std::size_t(width) * std::size_t(height) * 3);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
    spec.attribute("Compression", fmt::format("webp:{}", quality));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("webp", &memory);
    if (!output) fail("cannot encode WebP: {}", firstLine(OIIO::geterror()));
    output->set_ioproxy(&memory);
    if (!output->open("image", spec) || !output->write_image(OIIO::TypeUInt8, rgb.data()) || !output->close())
        fail("cannot encode WebP: {}", firstLine(output->geterror()));
    return bytes;
}

}  // namespace defocus::engine
