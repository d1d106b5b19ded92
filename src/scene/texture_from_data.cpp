#include "scene/texture_from_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/message.h"
#include "core/parallel.h"
#include "image/packed_pixels.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

// Half a step of an 8-bit value. Values outside [0, 1] by at most this much are rounding errors and are clamped.
constexpr float tolerance = 0.5f / 255;

void checkSize(const ImageView& image, const std::string& label) {
    if (image.width < 1 || image.height < 1)
        throw UsageError(fmt::format("{}: its image has no pixels ({} × {})", label, image.width, image.height));
    if (image.channels != 1 && image.channels != 3 && image.channels != 4)
        throw UsageError(fmt::format("{}: its image has {} channels; give 1, 3 or 4", label, image.channels));
    if (!coversItsPixels(image))
        throw UsageError(
            fmt::format("{}: an image of {} × {} pixels with {} channels needs more than the {} values given", label,
                        image.width, image.height, image.channels, image.pixels.size()));
}

bool premultiplied(const TextureData& texture) {
    return texture.image.channels == 4 && texture.content == TextureContent::color && !texture.straightAlpha;
}

void checkValues(const TextureData& texture, const std::string& label) {
    const ImageView& image = texture.image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* const pixel = image.at(x, y);
            for (int c = 0; c < image.channels; ++c)
                if (!(pixel[c] >= -tolerance && pixel[c] <= 1 + tolerance))
                    throw UsageError(
                        fmt::format("{}: channel {} of pixel ({}, {}) is {}; textures hold values from 0 to 1", label,
                                    c, x, y, pixel[c]));
            if (!premultiplied(texture)) continue;
            for (int c = 0; c < 3; ++c)
                if (pixel[c] > pixel[3] + tolerance)
                    throw UsageError(
                        fmt::format("{}: the colour {} of pixel ({}, {}) exceeds its alpha {}; premultiply the "
                                    "colours, or set straightAlpha",
                                    label, pixel[c], x, y, pixel[3]));
        }
}

std::uint8_t byteOf(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

TextureImage textureImage(const TextureData& texture, const std::string& label) {
    const ImageView& image = texture.image;
    checkSize(image, label);
    checkValues(texture, label);
    const bool encodes = texture.content == TextureContent::color;
    const bool divides = premultiplied(texture);
    TextureImage result{image.width, image.height, {}};
    const auto width = static_cast<std::size_t>(image.width);
    result.rgba.resize(width * static_cast<std::size_t>(image.height) * 4);
    parallelFor(static_cast<std::size_t>(image.height), [&](std::size_t row) {
        std::uint8_t* bytes = result.rgba.data() + row * width * 4;
        for (int x = 0; x < image.width; ++x, bytes += 4) {
            const float* const pixel = image.at(x, static_cast<int>(row));
            const float alpha = image.channels == 4 ? pixel[3] : 1;
            const float divisor = divides ? std::max(alpha, std::numeric_limits<float>::min()) : 1;
            for (int c = 0; c < 3; ++c) {
                const float value = pixel[image.channels == 1 ? 0 : c] / divisor;
                bytes[c] = byteOf(encodes ? srgbEncode(value) : value);
            }
            bytes[3] = byteOf(alpha);
        }
    });
    return result;
}

}  // namespace defocus::engine
