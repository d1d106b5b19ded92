#pragma once
// A float image: row 0 is the TOP row, channels interleaved, colours linear Rec.709, alpha premultiplied coverage.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace defocus {

struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;           // 1 (data), 3 (RGB) or 4 (RGBA, premultiplied)
    std::vector<float> pixels;  // width · height · channels

    Image() = default;
    Image(int imageWidth, int imageHeight, int imageChannels)
        : width(imageWidth),
          height(imageHeight),
          channels(imageChannels),
          pixels(static_cast<std::size_t>(imageWidth) * static_cast<std::size_t>(imageHeight) *
                 static_cast<std::size_t>(imageChannels)) {}

    [[nodiscard]] bool empty() const { return pixels.empty(); }
    // The first channel of the pixel in column x from the left and row y from the top.
    [[nodiscard]] float* at(int x, int y) { return pixels.data() + offset(x, y); }
    [[nodiscard]] const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

private:
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

// An 8-bit RGBA texture as a file holds it (encoded values, straight alpha), row 0 at the top.
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // width · height · 4
};

}  // namespace defocus
