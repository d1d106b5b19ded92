#include "image/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/tone_map.h"

namespace defocus::engine {
namespace {

float luminance(const glm::vec3& linear) {
    return 0.2126f * linear.r + 0.7152f * linear.g + 0.0722f * linear.b;
}

void expectEncoded(const glm::vec3& linear, int red, int green, int blue) {
    EXPECT_NEAR(255 * srgbEncode(linear.r), red, 0.5);
    EXPECT_NEAR(255 * srgbEncode(linear.g), green, 0.5);
    EXPECT_NEAR(255 * srgbEncode(linear.b), blue, 0.5);
}

TEST(ColourMap, endsAndMiddleArePublishedColours) {
    expectEncoded(magma(0), 0, 0, 4);
    expectEncoded(magma(0.5f), 183, 55, 121);
    expectEncoded(magma(1), 252, 253, 191);
    expectEncoded(viridis(0), 68, 1, 84);
    expectEncoded(viridis(0.5f), 33, 145, 140);
    expectEncoded(viridis(1), 253, 231, 37);
}

TEST(ColourMap, lightnessRisesAllTheWay) {
    for (int i = 0; i < 200; ++i) {
        const float t = static_cast<float>(i) / 200.0f;
        EXPECT_LT(luminance(magma(t)), luminance(magma(t + 0.005f))) << t;
        EXPECT_LT(luminance(viridis(t)), luminance(viridis(t + 0.005f))) << t;
    }
}

TEST(ColourMap, outsideIsClamped) {
    EXPECT_EQ(magma(-3), magma(0));
    EXPECT_EQ(magma(std::numeric_limits<float>::quiet_NaN()), magma(0));
    EXPECT_EQ(viridis(std::numeric_limits<float>::infinity()), viridis(1));
}

TEST(ColourMap, anErrorImageIsColouredPixelByPixel) {
    Image values(2, 2, 1);
    values.pixels = {0, 0.25f, 0.5f, 1};
    const Image coloured = colourMapped(values);
    ASSERT_EQ(coloured.channels, 3);
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(coloured.at(i % 2, i / 2)[c], magma(values.pixels[static_cast<std::size_t>(i)])[c]);
}

}  // namespace
}  // namespace defocus::engine
