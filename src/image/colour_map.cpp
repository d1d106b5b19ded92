#include "image/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/parallel.h"
#include "image/tone_map.h"

namespace defocus {

namespace {

// sRGB colours at 0, 0.1 … 1; in between, encoded values are interpolated linearly.
using Table = std::array<std::uint32_t, 11>;
constexpr Table magmaTable = {0x000004, 0x140e36, 0x3b0f70, 0x641a80, 0x8c2981, 0xb73779,
                              0xde4968, 0xf7705c, 0xfe9f6d, 0xfecf92, 0xfcfdbf};
constexpr Table viridisTable = {0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c,
                                0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725};

glm::vec3 interpolated(const Table& table, float t) {
    const float position = (t > 0 ? std::min(t, 1.0f) : 0.0f) * static_cast<float>(table.size() - 1);
    const std::size_t lower = std::min(static_cast<std::size_t>(position), table.size() - 2);
    const float fraction = position - static_cast<float>(lower);
    glm::vec3 colour;
    for (int c = 0; c < 3; ++c) {
        const int shift = 16 - 8 * c;
        const auto below = static_cast<float>((table[lower] >> shift) & 0xffu);
        const auto above = static_cast<float>((table[lower + 1] >> shift) & 0xffu);
        colour[c] = srgbDecode(std::lerp(below, above, fraction) / 255.0f);
    }
    return colour;
}

}  // namespace

glm::vec3 magma(float t) {
    return interpolated(magmaTable, t);
}

glm::vec3 viridis(float t) {
    return interpolated(viridisTable, t);
}

Image colourMapped(const Image& values) {
    Image coloured(values.width, values.height, 3);
    parallelFor(static_cast<std::size_t>(values.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < values.width; ++x) {
            const glm::vec3 colour = magma(*values.at(x, y));
            for (int c = 0; c < 3; ++c) coloured.at(x, y)[c] = colour[c];
        }
    });
    return coloured;
}

}  // namespace defocus
