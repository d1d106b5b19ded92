#include "image/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace defocus::engine {
namespace {

std::vector<float> shown(std::vector<float> rgb, ToneMap toneMap, double exposure = 0) {
    Image image(1, 1, static_cast<int>(rgb.size()));
    image.pixels = std::move(rgb);
    return displayEncoded(image, toneMap, exposure).pixels;
}

// Returns Hill's rational fit of the ACES tone map for a grey value. The matrices before and after the curve preserve
// greys, since their rows sum to 1.
double hillCurve(double v) {
    return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
}

TEST(Srgb, knownValues) {
    EXPECT_NEAR(srgbEncode(0.5f), 0.7353570f, 1e-6);
    EXPECT_NEAR(srgbDecode(0.5f), 0.2140411f, 1e-6);
    EXPECT_NEAR(srgbEncode(0.0031308f), 0.04045f, 1e-5);
    EXPECT_EQ(srgbEncode(1.0f), 1.0f);
    EXPECT_EQ(srgbDecode(1.0f), 1.0f);
}

TEST(Srgb, decodeInvertsEncode) {
    for (int i = 0; i <= 1000; ++i) {
        const float value = static_cast<float>(i) / 1000.0f;
        EXPECT_NEAR(srgbDecode(srgbEncode(value)), value, 2e-6);
    }
}

TEST(Srgb, outsideIsClampedAndNanIsBlack) {
    EXPECT_EQ(srgbEncode(-1.0f), 0.0f);
    EXPECT_EQ(srgbEncode(7.0f), 1.0f);
    EXPECT_EQ(srgbEncode(std::numeric_limits<float>::infinity()), 1.0f);
    EXPECT_EQ(srgbEncode(std::numeric_limits<float>::quiet_NaN()), 0.0f);
}

TEST(ToneMapped, exposureIsInStops) {
    EXPECT_NEAR(shown({0.1f, 0.05f, 0.2f}, ToneMap::none, 1)[1], srgbEncode(0.1f), 1e-6);
    EXPECT_NEAR(shown({0.1f, 0.05f, 0.2f}, ToneMap::none, -1)[2], srgbEncode(0.1f), 1e-6);
}

TEST(ToneMapped, acesOnGreysIsHillsCurve) {
    for (const float value : {0.01f, 0.18f, 0.5f, 1.0f, 2.0f, 8.0f})
        for (const float channel : shown({value, value, value}, ToneMap::aces))
            EXPECT_NEAR(channel, srgbEncode(static_cast<float>(hillCurve(value))), 2e-4) << value;
}

TEST(ToneMapped, agxKeepsMiddleGreyAndGreysGrey) {
    // AgX's sigmoid maps its pivot, stop 10 of 16.5, to half the display range. Middle grey 0.18 lies at the pivot.
    for (const float channel : shown({0.18f, 0.18f, 0.18f}, ToneMap::agx)) EXPECT_NEAR(channel, 0.5f, 0.005);
    for (const float value : {0.001f, 0.02f, 0.5f, 3.0f, 12.0f}) {
        const auto rgb = shown({value, value, value}, ToneMap::agx);
        EXPECT_NEAR(rgb[0], rgb[1], 1e-3);
        EXPECT_NEAR(rgb[2], rgb[1], 1e-3);
    }
}

// Compares Khronos PBR Neutral with properties from its specification. If every channel is from 0.08 to 0.8, the curve
// only subtracts 0.04, to compensate for the Fresnel reflection of dielectrics. Above this range, the curve is
// continuous and stays below 1.
TEST(ToneMapped, neutralKeepsColoursAndRollsHighlightsOff) {
    const auto kept = shown({0.5f, 0.3f, 0.1f}, ToneMap::neutral);
    EXPECT_NEAR(kept[0], srgbEncode(0.46f), 1e-5);
    EXPECT_NEAR(kept[1], srgbEncode(0.26f), 1e-5);
    EXPECT_NEAR(kept[2], srgbEncode(0.06f), 1e-5);
    EXPECT_NEAR(shown({0.04f, 0.04f, 0.04f}, ToneMap::neutral)[0], srgbEncode(0.01f), 1e-5);
    EXPECT_NEAR(shown({0.8f, 0.8f, 0.8f}, ToneMap::neutral)[0], srgbEncode(0.76f), 1e-5);
    // Above x = 0.8, the curve is 1 − 0.24² / (x − 0.04 + 0.24 − 0.76), a hyperbola that joins the line x − 0.04 with
    // slope 1.
    EXPECT_NEAR(shown({2, 2, 2}, ToneMap::neutral)[0], srgbEncode(1 - 0.24f * 0.24f / 1.44f), 1e-5);
    EXPECT_LT(shown({100, 100, 100}, ToneMap::neutral)[0], 1);
    for (const float channel : shown({1e4f, 0, 0}, ToneMap::neutral)) EXPECT_GT(channel, 0.95f);
}

TEST(ToneMapped, agxTurnsTheBrightestRedWhiteAndClippingDoesNot) {
    for (const float channel : shown({1e4f, 0, 0}, ToneMap::agx)) EXPECT_GT(channel, 0.95f);
    EXPECT_EQ(shown({1e4f, 0, 0}, ToneMap::none)[1], 0.0f);
}

TEST(ToneMapped, curvesRiseAndKeepHues) {
    for (const ToneMap toneMap : {ToneMap::none, ToneMap::aces, ToneMap::agx, ToneMap::neutral}) {
        float previous = -1;
        for (int stop = -120; stop <= 60; ++stop) {
            const float value = std::exp2(static_cast<float>(stop) / 10.0f);
            const float green = shown({value, value, value}, toneMap)[1];
            EXPECT_GE(green, previous - 1e-6f);
            previous = green;
        }
        const auto orange = shown({0.4f, 0.15f, 0.03f}, toneMap);
        EXPECT_GT(orange[0], orange[1] + 0.05f);
        EXPECT_GT(orange[1], orange[2] + 0.05f);
    }
}

TEST(ToneMapped, everyInputGivesAValueInRange) {
    const float infinity = std::numeric_limits<float>::infinity();
    const float notANumber = std::numeric_limits<float>::quiet_NaN();
    for (const ToneMap toneMap : {ToneMap::none, ToneMap::aces, ToneMap::agx, ToneMap::neutral})
        for (const float value : {notANumber, infinity, -infinity, -5.0f, 0.0f, 1e-38f, 3e38f})
            for (const double exposure : {-20.0, 0.0, 20.0})
                for (const float channel : shown({value, 0.5f, value}, toneMap, exposure))
                    EXPECT_TRUE(channel >= 0 && channel <= 1) << value << " → " << channel;
}

TEST(ToneMapped, alphaIsKept) {
    const auto pixel = shown({0.2f, 0.2f, 0.2f, 0.4f}, ToneMap::none, 3);
    ASSERT_EQ(pixel.size(), 4u);
    EXPECT_EQ(pixel[3], 0.4f);
}

TEST(ToneMapped, aGreyImageIsShownAsThatGrey) {
    for (const ToneMap toneMap : {ToneMap::none, ToneMap::aces, ToneMap::agx, ToneMap::neutral})
        EXPECT_EQ(shown({0.3f}, toneMap)[0], shown({0.3f, 0.3f, 0.3f}, toneMap)[1]);
}

}  // namespace
}  // namespace defocus::engine
