#include "image/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "image/tone_map.h"
#include "special_values.h"

namespace defocus::engine {
namespace {

Image constant(int width, int height, int channels, float value) {
    Image image(width, height, channels);
    std::ranges::fill(image.pixels, value);
    return image;
}

// Returns an image with smooth structure and a little noise.
Image pattern(int width, int height, int channels, unsigned seed) {
    Image image(width, height, channels);
    std::uint32_t state = seed;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
                state = state * 1664525u + 1013904223u;
                const float noise = static_cast<float>(state >> 8) / 16777216.0f;
                image.at(x, y)[c] = 0.3f + 0.2f * std::sin(0.3f * static_cast<float>(x + y * c)) + 0.3f * noise;
            }
    return image;
}

// Returns the SSIM by the paper's definition: one 2D window per pixel, for all windows inside the image.
double directSsim(const Image& a, const Image& b) {
    const auto luma = [](const Image& image, int x, int y) {
        const float* p = image.at(x, y);
        return 0.2126 * srgbEncode(p[0]) + 0.7152 * srgbEncode(p[1]) + 0.0722 * srgbEncode(p[2]);
    };
    double total = 0;
    int windows = 0;
    for (int y = 5; y + 5 < a.height; ++y)
        for (int x = 5; x + 5 < a.width; ++x) {
            double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
            for (int pass = 0; pass < 2; ++pass)
                for (int j = -5; j <= 5; ++j)
                    for (int i = -5; i <= 5; ++i) {
                        const double w = std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5));
                        const double p = luma(a, x + i, y + j), q = luma(b, x + i, y + j);
                        if (pass == 0) {
                            weights += w;
                            ma += w * p;
                            mb += w * q;
                        } else {
                            va += w / weights * (p - ma / weights) * (p - ma / weights);
                            vb += w / weights * (q - mb / weights) * (q - mb / weights);
                            cov += w / weights * (p - ma / weights) * (q - mb / weights);
                        }
                    }
            ma /= weights;
            mb /= weights;
            total += (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
            ++windows;
        }
    return total / windows;
}

TEST(Difference, ofEqualImagesIsNone) {
    const Image image = pattern(30, 20, 3, 1);
    const Difference difference = compareImages(image, image);
    EXPECT_EQ(difference.mae, 0);
    EXPECT_EQ(difference.rmse, 0);
    EXPECT_EQ(difference.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(difference.ssim, 1);
    EXPECT_EQ(difference.flip, 0);
    EXPECT_EQ(difference.maxError, 0);
    EXPECT_EQ(difference.pixelCount, 600u);
    EXPECT_EQ(difference.nonFinite, 0u);
}

TEST(Difference, ofConstantImagesIsClosedForm) {
    const double a = 0.6, b = 0.5;  // display values
    const Difference difference =
        compareImages(constant(32, 24, 3, srgbDecode(0.6f)), constant(32, 24, 3, srgbDecode(0.5f)));
    EXPECT_NEAR(difference.mae, 0.1, 1e-6);
    EXPECT_NEAR(difference.rmse, 0.1, 1e-6);
    EXPECT_NEAR(difference.psnr, 20, 1e-4);
    EXPECT_NEAR(difference.maxError, 0.1, 1e-6);
    // For uniform images, SSIM consists only of its luminance term.
    EXPECT_NEAR(difference.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
}

TEST(Difference, ofBlackAndWhiteIsTheLargest) {
    const Difference difference = compareImages(constant(32, 24, 3, 0), constant(32, 24, 3, 1));
    EXPECT_EQ(difference.mae, 1);
    EXPECT_EQ(difference.rmse, 1);
    EXPECT_EQ(difference.psnr, 0);
    EXPECT_NEAR(difference.ssim, 1e-4 / (1 + 1e-4), 1e-9);
}

TEST(Difference, ofOneChannelOfOnePixel) {
    Image reference = constant(10, 8, 3, srgbDecode(0.25f));
    Image test = reference;
    test.at(7, 3)[1] = srgbDecode(0.75f);
    const Difference difference = compareImages(reference, test);
    EXPECT_NEAR(difference.mae, 0.5 / 240, 1e-8);
    EXPECT_NEAR(difference.rmse, 0.5 / std::sqrt(240.0), 1e-7);
    EXPECT_NEAR(difference.psnr, -20 * std::log10(0.5 / std::sqrt(240.0)), 1e-4);
    EXPECT_NEAR(difference.maxError, 0.5, 1e-6);
    EXPECT_EQ(difference.maxErrorPixel, (Pixel{7, 3}));
}

TEST(Difference, isMeasuredOnClippedDisplayValues) {
    EXPECT_EQ(compareImages(constant(4, 4, 3, 3.0f), constant(4, 4, 3, 50.0f)).rmse, 0);
    EXPECT_EQ(compareImages(constant(4, 4, 3, -2.0f), constant(4, 4, 3, 0.0f)).rmse, 0);
}

TEST(Ssim, agreesWithTheDefinition) {
    for (const unsigned seed : {2u, 3u}) {
        const Image a = pattern(25, 19, 3, 1);
        const Image b = pattern(25, 19, 3, seed);
        const double expected = directSsim(a, b);
        EXPECT_NEAR(compareImages(a, b).ssim, expected, 1e-9);
        EXPECT_LT(expected, 0.95);
    }
}

TEST(Ssim, ofImagesSmallerThanItsWindowIsDefined) {
    const Difference difference =
        compareImages(constant(1, 3, 3, srgbDecode(0.6f)), constant(1, 3, 3, srgbDecode(0.5f)));
    EXPECT_NEAR(difference.ssim, (2 * 0.3 + 1e-4) / (0.61 + 1e-4), 1e-6);
}

TEST(Difference, greyCountsAsRgbAndAlphaAsOverBlack) {
    const Image grey = pattern(20, 20, 1, 1);
    Image rgb(20, 20, 3), rgba(20, 20, 4);
    for (int i = 0; i < 400; ++i)
        for (int c = 0; c < 4; ++c) {
            if (c < 3) rgb.at(i % 20, i / 20)[c] = *grey.at(i % 20, i / 20);
            rgba.at(i % 20, i / 20)[c] = c < 3 ? *grey.at(i % 20, i / 20) : 0.5f;
        }
    EXPECT_EQ(compareImages(grey, rgb).rmse, 0);
    EXPECT_EQ(compareImages(rgba, grey).rmse, 0);
    EXPECT_EQ(compareImages(rgba, grey).flip, 0);
}

TEST(NonFinite, inOneImageIsTheLargestDifferenceThereAndNowhereElse) {
    for (const float bad : {notANumber, infinity, -infinity}) {
        const Image reference = pattern(40, 30, 3, 1);
        Image test = reference;
        test.at(21, 11)[2] = bad;
        for (const bool swapped : {false, true}) {
            Image map;
            CompareOptions options;
            options.flipMap = &map;
            const Difference difference =
                swapped ? compareImages(test, reference, options) : compareImages(reference, test, options);
            EXPECT_NEAR(difference.mae, 1.0 / 1200, 1e-12);
            EXPECT_NEAR(difference.rmse, std::sqrt(1.0 / 1200), 1e-12);
            EXPECT_EQ(difference.maxError, 1);
            EXPECT_EQ(difference.maxErrorPixel, (Pixel{21, 11}));
            EXPECT_NEAR(difference.ssim, 1 - 1.0 / (30 * 20), 1e-12);
            EXPECT_NEAR(difference.flip, 1.0 / 1200, 1e-9);
            EXPECT_EQ(difference.nonFinite, 1u);
            EXPECT_EQ(*map.at(21, 11), 1);
            EXPECT_EQ(std::ranges::count(map.pixels, 0.0f), 1199);
        }
    }
}

TEST(NonFinite, inBothImagesIsEqualButCounted) {
    Image reference = pattern(20, 16, 3, 1);
    Image test = reference;
    reference.at(3, 4)[0] = notANumber;
    test.at(3, 4)[1] = infinity;
    const Difference difference = compareImages(reference, test);
    EXPECT_EQ(difference.rmse, 0);
    EXPECT_EQ(difference.ssim, 1);
    EXPECT_EQ(difference.flip, 0);
    EXPECT_EQ(difference.nonFinite, 1u);
}

TEST(Mask, onlyItsPixelsCount) {
    const Image reference = constant(40, 30, 3, srgbDecode(0.5f));
    Image test = reference;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x)
            for (int c = 0; c < 3; ++c) test.at(x, y)[c] = srgbDecode(0.7f);
    Image left(40, 30, 1), farRight(40, 30, 1);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            *left.at(x, y) = x < 20 ? 1.0f : 0.0f;
            *farRight.at(x, y) = x >= 32 ? 1.0f : 0.0f;
        }
    CompareOptions options;
    options.mask = &left;
    const Difference inside = compareImages(reference, test, options);
    EXPECT_NEAR(inside.rmse, 0.2, 1e-6);
    EXPECT_EQ(inside.pixelCount, 600u);
    options.mask = &farRight;
    const Difference outside = compareImages(reference, test, options);
    EXPECT_EQ(outside.rmse, 0);
    EXPECT_NEAR(outside.ssim, 1, 1e-12);
    EXPECT_EQ(outside.flip, 0);
    EXPECT_NEAR(compareImages(reference, test).mae, 0.1, 1e-6);
}

TEST(Mask, thatHoldsNothingOrDoesNotFit) {
    const Image black = constant(12, 12, 3, 0), white = constant(12, 12, 3, 1);
    const Image nothing(12, 12, 1);
    CompareOptions options;
    options.mask = &nothing;
    const Difference difference = compareImages(black, white, options);
    EXPECT_EQ(difference.pixelCount, 0u);
    EXPECT_EQ(difference.rmse, 0);
    EXPECT_EQ(difference.maxError, 0);
    EXPECT_EQ(difference.ssim, 1);
    const Image small(11, 12, 1);
    options.mask = &small;
    EXPECT_THROW(compareImages(black, white, options), Error);
}

TEST(Difference, ofImagesOfDifferentSizesIsRefused) {
    EXPECT_THROW(compareImages(constant(4, 4, 3, 0), constant(4, 5, 3, 0)), Error);
    EXPECT_THROW(compareImages(Image{}, Image{}), Error);
}

}  // namespace
}  // namespace defocus::engine
