#include "image/half_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>

namespace defocus::engine {

HalfImage halfImage(const ImageView& image) {
    assert(image.channels == 4 && image.isPacked());
    std::vector<float> clamped(image.pixels.begin(), image.pixels.end());
    for (float& value : clamped) value = std::clamp(value, -maxHalf, maxHalf);
    HalfImage result{image.width, image.height, std::vector<std::uint16_t>(clamped.size())};
    OIIO::convert_pixel_values(OIIO::TypeFloat, clamped.data(), OIIO::TypeHalf, result.rgba.data(),
                               static_cast<int>(clamped.size()));
    return result;
}

void addHalves(const std::uint16_t* __restrict halves, std::size_t count, float* __restrict sums) {
    for (std::size_t i = 0; i < count; ++i) sums[i] += fromHalf(halves[i]);
}

}  // namespace defocus::engine
