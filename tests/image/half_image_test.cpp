// Tests 16-bit floats against the definition of binary16 in IEEE 754.

#include "image/half_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace defocus::engine {
namespace {

TEST(HalfImage, valuesAreThoseOfTheStandard) {
    for (std::uint32_t half = 0; half < 0x10000; ++half) {
        const int exponent = static_cast<int>(half >> 10 & 31);
        const double fraction = (half & 1023) / 1024.0;
        const double sign = (half & 0x8000) != 0 ? -1 : 1;
        const float value = fromHalf(static_cast<std::uint16_t>(half));
        if (exponent == 31 && fraction > 0)
            EXPECT_TRUE(std::isnan(value)) << half;
        else if (exponent == 31)
            EXPECT_EQ(value, sign * std::numeric_limits<double>::infinity()) << half;
        else
            EXPECT_EQ(value,
                      sign * (exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15)))
                << half;
    }
}

TEST(HalfImage, roundsToTheNearestAndClamps) {
    Image image(1, 2, 4);
    image.pixels = {0.25f, 1 + 1.2f / 2048, -1 - 0.8f / 2048, 1e6f, -1e6f, 65519, 0, 4e-8f};
    const HalfImage half = halfImage(image);
    std::ranges::transform(half.rgba, image.pixels.begin(), fromHalf);
    EXPECT_EQ(image.pixels, (std::vector<float>{0.25f, 1 + 1.0f / 1024, -1, 65504, -65504, 65504, 0, 0x1p-24f}));
    EXPECT_EQ(halfImage(image).rgba, half.rgba);
}

}  // namespace
}  // namespace defocus::engine
