#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"
#include "image/image_io.h"
#include "models.h"

namespace defocus::engine {
namespace {

Image noise(int width, int height, unsigned seed, float brightest) {
    Image image(width, height, 3);
    std::uint32_t state = seed;
    for (float& value : image.pixels) {
        state = state * 1664525u + 1013904223u;
        value = brightest * static_cast<float>(state >> 8) / 16777216.0f;
    }
    return image;
}

Image constant(float red, float green, float blue) {
    Image image(24, 24, 3);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        image.pixels[i] = red;
        image.pixels[i + 1] = green;
        image.pixels[i + 2] = blue;
    }
    return image;
}

double meanOf(const Image& map) {
    return std::accumulate(map.pixels.begin(), map.pixels.end(), 0.0) / static_cast<double>(map.pixels.size());
}

struct KnownValue {
    const char* reference;
    const char* test;
    bool hdr;
    double mean;
    double largest;
};

class KnownFlip : public testing::TestWithParam<KnownValue> {};

// FLIP agrees with the authors' implementation within a tenth of the tolerance that the authors allow.
TEST_P(KnownFlip, agrees) {
    const KnownValue& known = GetParam();
    const std::filesystem::path folder = std::filesystem::path(DEFOCUS_SOURCE_DIR) / "tests/data/flip";
    std::optional<HdrFlipOptions> hdr;
    if (known.hdr) hdr = {.startExposure = -4, .stopExposure = 2, .exposures = 4};
    const Image map = flipErrorMap(readImage(folder / known.reference), readImage(folder / known.test), hdr);
    EXPECT_NEAR(meanOf(map), known.mean, 1e-4);
    EXPECT_NEAR(*std::ranges::max_element(map.pixels), known.largest, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Authors, KnownFlip,
    testing::Values(KnownValue{"fish_reference.png", "fish_8samples.png", false, 0.061273, 0.365989},
                    KnownValue{"checker.png", "checker_shift1.png", false, 0.208635, 0.817509},
                    KnownValue{"black.png", "white.png", false, 0.967365, 0.967388},
                    KnownValue{"fish_reference.exr", "fish_8samples.exr", true, 0.067508, 0.444818},
                    KnownValue{"fish_reference_hdr.exr", "fish_8samples_hdr.exr", true, 0.064231, 0.409475}),
    [](const auto& known) { return testNameOf(known.param.reference); });

TEST(Flip, ofEqualImagesIsZeroEverywhere) {
    const Image image = noise(40, 30, 1, 2.0f);
    EXPECT_EQ(std::ranges::count(flipErrorMap(image, image).pixels, 0.0f), 1200);
    EXPECT_EQ(std::ranges::count(flipErrorMap(image, image, HdrFlipOptions{}).pixels, 0.0f), 1200);
}

TEST(Flip, isSymmetricAndBounded) {
    const Image a = noise(40, 30, 1, 1.0f), b = noise(40, 30, 2, 1.0f);
    const Image ab = flipErrorMap(a, b), ba = flipErrorMap(b, a);
    EXPECT_EQ(ab.pixels, ba.pixels);
    for (const float value : ab.pixels) EXPECT_TRUE(value > 0 && value <= 1);
}

// FLIP normalizes colour differences by the difference between green and blue. The FLIP of these two colours is
// therefore 1.
TEST(Flip, betweenGreenAndBlueIsOne) {
    for (const float value : flipErrorMap(constant(0, 1, 0), constant(0, 0, 1)).pixels) EXPECT_NEAR(value, 1, 1e-4);
}

// The HyAB difference of greys is their difference in lightness, since greys have no chroma. It is 100 between black
// and white. In the linear part of L*, a grey of luminance Y differs from black by 903.3·Y.
TEST(Flip, betweenDarkGreysFollowsLightness) {
    const double blackWhite = meanOf(flipErrorMap(constant(0, 0, 0), constant(1, 1, 1)));
    const double lightness = 0.008 * 24389.0 / 27.0;
    const double dark = meanOf(flipErrorMap(constant(0, 0, 0), constant(0.008f, 0.008f, 0.008f)));
    // FLIP maps the colour difference e, whose max is M, to 0.95·e/(0.4·M) up to e = 0.4·M, and to 0.95 + 0.05·(e −
    // 0.4·M)/(0.6·M) above. Between black and white, e = 100^0.7.
    const double largest = std::pow(100.0, 0.7) * 0.05 / 0.6 / (blackWhite - 0.95 + 0.4 * 0.05 / 0.6);
    EXPECT_NEAR(dark, std::pow(lightness, 0.7) * 0.95 / (0.4 * largest), 1e-4);
}

TEST(Flip, isSmallerFromFartherAway) {
    Image checker(48, 48, 3);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x)
            for (int c = 0; c < 3; ++c) checker.at(x, y)[c] = (x + y) % 2 == 0 ? 1.0f : 0.0f;
    Image grey(48, 48, 3);
    std::ranges::fill(grey.pixels, 0.5f);
    double previous = 2;
    for (const double pixelsPerDegree : {10.0, 20.0, 40.0, 80.0}) {
        const double mean = meanOf(flipErrorMap(checker, grey, {}, pixelsPerDegree));
        EXPECT_LT(mean, 0.9 * previous);
        previous = mean;
    }
    EXPECT_LT(previous, 0.01);
}

// HDR-FLIP at one exposure equals LDR-FLIP of the tone-mapped images. The tone map is ACES as fitted by Narkowicz
// (2015), applied to 0.6 times the exposed radiance and clamped to 1.
TEST(HdrFlip, isLdrFlipOfToneMappedImages) {
    const Image a = noise(30, 20, 1, 9.0f), b = noise(30, 20, 2, 9.0f);
    for (const double exposure : {-3.0, 0.0, 1.5}) {
        const auto toneMapped = [&](Image image) {
            for (float& value : image.pixels) {
                const double x = 0.6 * std::exp2(exposure) * static_cast<double>(value);
                value = static_cast<float>(std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0));
            }
            return image;
        };
        const HdrFlipOptions one{.startExposure = exposure, .stopExposure = exposure, .exposures = 1};
        const Image hdr = flipErrorMap(a, b, one), ldr = flipErrorMap(toneMapped(a), toneMapped(b));
        for (std::size_t i = 0; i < hdr.pixels.size(); ++i) ASSERT_NEAR(hdr.pixels[i], ldr.pixels[i], 2e-4) << i;
    }
}

TEST(HdrFlip, isTheWorstOfItsExposures) {
    const Image a = noise(30, 20, 1, 9.0f), b = noise(30, 20, 2, 9.0f);
    const Image all = flipErrorMap(a, b, HdrFlipOptions{.startExposure = -3, .stopExposure = 3, .exposures = 3});
    Image worst(30, 20, 1);
    for (const double exposure : {-3.0, 0.0, 3.0}) {
        const Image one =
            flipErrorMap(a, b, HdrFlipOptions{.startExposure = exposure, .stopExposure = exposure, .exposures = 1});
        for (std::size_t i = 0; i < worst.pixels.size(); ++i)
            worst.pixels[i] = std::max(worst.pixels[i], one.pixels[i]);
    }
    EXPECT_EQ(all.pixels, worst.pixels);
}

TEST(HdrFlip, doesNotChangeWhenImagesAndExposuresShiftTogether) {
    const Image a = noise(30, 20, 1, 9.0f), b = noise(30, 20, 2, 9.0f);
    Image brightA = a, brightB = b;
    for (float& value : brightA.pixels) value *= 4;
    for (float& value : brightB.pixels) value *= 4;
    const Image map = flipErrorMap(a, b, HdrFlipOptions{.startExposure = -1, .stopExposure = 2, .exposures = 4});
    const Image shifted =
        flipErrorMap(brightA, brightB, HdrFlipOptions{.startExposure = -3, .stopExposure = 0, .exposures = 4});
    EXPECT_EQ(map.pixels, shifted.pixels);
}

TEST(HdrFlip, seesWhatLdrClips) {
    const Image a = constant(2, 2, 2), b = constant(9, 9, 9);
    EXPECT_EQ(meanOf(flipErrorMap(a, b)), 0);
    EXPECT_GT(meanOf(flipErrorMap(a, b, HdrFlipOptions{})), 0.2);
}

TEST(HdrFlip, survivesTheLargestFloats) {
    const Image a = constant(3e38f, 0, 1), b = constant(0, 3e38f, 1);
    for (const float value :
         flipErrorMap(a, b, HdrFlipOptions{.startExposure = 0, .stopExposure = 60, .exposures = 3}).pixels)
        EXPECT_TRUE(value > 0 && value <= 1) << value;
}

TEST(Flip, refusesOptionsOutOfRange) {
    const Image a = constant(0, 0, 0);
    const double notANumber = std::nan("");
    EXPECT_THROW(flipErrorMap(a, a, {}, 0), Error);
    EXPECT_THROW(flipErrorMap(a, a, {}, notANumber), Error);
    EXPECT_THROW(flipErrorMap(a, a, HdrFlipOptions{.startExposure = 2, .stopExposure = 1, .exposures = 4}), Error);
    EXPECT_THROW(flipErrorMap(a, a, HdrFlipOptions{.startExposure = notANumber, .stopExposure = 1, .exposures = 4}),
                 Error);
    EXPECT_THROW(flipErrorMap(a, a, HdrFlipOptions{.startExposure = 0, .stopExposure = 1, .exposures = 0}), Error);
}

}  // namespace
}  // namespace defocus::engine
