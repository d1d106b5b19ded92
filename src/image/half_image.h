#pragma once
// RGBA images of 16-bit floats (IEEE 754 binary16), which take half of the memory of an Image.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

inline constexpr float maxHalf = 65504;  // largest finite 16-bit float

struct HalfImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> rgba;  // width · height · 4

    // Returns a pointer to the first channel of the pixel in column x and row y.
    [[nodiscard]] const std::uint16_t* at(int x, int y) const {
        return rgba.data() +
               4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

// Returns the value of a 16-bit float. Has no branches, so that loops over pixels are vectorised.
inline float fromHalf(std::uint16_t half) {
    const std::uint32_t magnitude = (half & 0x7fffu) << 13;
    const auto finite = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) * 0x1p112f);
    const std::uint32_t value = magnitude >= 0x0f800000u ? magnitude | 0x7f800000u : finite;  // keeps infinity and NaN
    return std::bit_cast<float>(value | (half & 0x8000u) << 16);
}

// Returns the RGBA image with values rounded to 16 bits and clamped to ±maxHalf.
HalfImage halfImage(const ImageView& image);

// Adds each of `count` finite 16-bit floats to the sum with the same index.
void addHalves(const std::uint16_t* halves, std::size_t count, float* sums);

}  // namespace defocus::engine
