#include "image/colour_map.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

// Linear colours of a colour map at 0, 1/255, …, 1.
using Table = std::array<glm::vec3, 256>;

Table tableOf(const char* name) {
    std::array<float, std::tuple_size_v<Table>> shares;
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = static_cast<float>(i) / (shares.size() - 1);
    const OIIO::ImageBuf ramp(OIIO::ImageSpec(shares.size(), 1, 1, OIIO::TypeFloat), shares.data());
    Table table;
    OIIO::ImageBufAlgo::color_map(ramp, 0, name).get_pixels(OIIO::ROI::All(), OIIO::TypeFloat, table.data());
    return table;
}

glm::vec3 interpolated(const Table& table, float t) {
    const float position = (t > 0 ? std::min(t, 1.0f) : 0.0f) * static_cast<float>(table.size() - 1);
    const std::size_t lower = std::min(static_cast<std::size_t>(position), table.size() - 2);
    return glm::mix(table[lower], table[lower + 1], position - static_cast<float>(lower));
}

}  // namespace

glm::vec3 magma(float t) {
    static const Table table = tableOf("magma");
    return interpolated(table, t);
}

glm::vec3 viridis(float t) {
    static const Table table = tableOf("viridis");
    return interpolated(table, t);
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

}  // namespace defocus::engine
