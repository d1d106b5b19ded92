#include "lens/lens_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace defocus {
namespace {

TEST(LensSamples, radicalInverseOfTheFirstIntegers) {
    const double base2[] = {0, 0.5, 0.25, 0.75, 0.125};
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(radicalInverse(2, i), base2[i]);
    EXPECT_NEAR(radicalInverse(3, 5), 2.0 / 3 + 1.0 / 9, 1e-15);  // 5 = 12 in base 3, mirrored 0.21
}

TEST(LensSamples, firstSampleIsThePinhole) {
    for (const int blades : {0, 3, 6}) {
        Lens lens;
        lens.bladeCount = blades;
        const LensSample sample = lensSample(lens, 0, 0);
        EXPECT_NEAR(sample.lens.x, 0, 1e-7);
        EXPECT_NEAR(sample.lens.y, 0, 1e-7);
        EXPECT_NEAR(sample.pixel.x, 0, 1e-7);
        EXPECT_NEAR(sample.pixel.y, 0, 1e-7);
    }
}

// Moments of a uniform shape: mean 0, and per axis the second moment 1/4 for the disk, and for a regular n-gon
// inscribed in the unit circle (1/12)(1 + 2cos²(π/n))·… = (2 + cos(2π/n))/12.
TEST(LensSamples, momentsAreThoseOfTheShape) {
    for (const int blades : {0, 3, 5, 6, 8}) {
        Lens lens;
        lens.bladeCount = blades;
        lens.bladeRotation = 0.3;
        const int n = 1 << 16;
        glm::dvec2 mean(0);
        glm::dvec2 square(0);
        for (const LensSample& sample : lensSamples(lens, n, 0)) {
            const glm::dvec2 p(sample.lens);
            EXPECT_LE(p.x * p.x + p.y * p.y, 1 + 1e-6);
            mean += p / double(n);
            square += p * p / double(n);
        }
        const double expected = blades == 0 ? 0.25 : (2 + std::cos(2 * std::numbers::pi / blades)) / 12;
        EXPECT_NEAR(mean.x, 0, 1e-3) << blades;
        EXPECT_NEAR(mean.y, 0, 1e-3) << blades;
        EXPECT_NEAR(square.x, expected, 2e-3) << blades;
        EXPECT_NEAR(square.y, expected, 2e-3) << blades;
    }
}

TEST(LensSamples, anamorphicRatioNarrowsOneAxis) {
    Lens lens;
    lens.anamorphicRatio = 2;
    double widest = 0;
    double tallest = 0;
    for (const LensSample& sample : lensSamples(lens, 4096, 0)) {
        widest = std::max(widest, std::abs(double(sample.lens.x)));
        tallest = std::max(tallest, std::abs(double(sample.lens.y)));
    }
    EXPECT_NEAR(widest, 0.5, 0.01);
    EXPECT_NEAR(tallest, 1, 0.01);
}

TEST(LensSamples, pixelOffsetsFillThePixelEvenly) {
    int quadrants[4] = {};
    for (const LensSample& sample : lensSamples(Lens{}, 4096, 0)) {
        ASSERT_GE(sample.pixel.x, -0.5f);
        ASSERT_LE(sample.pixel.x, 0.5f);
        ++quadrants[(sample.pixel.x < 0 ? 0 : 1) + (sample.pixel.y < 0 ? 0 : 2)];
    }
    for (const int count : quadrants) EXPECT_NEAR(count, 1024, 12);
}

// The sample split draws a prefix of the sequence with one level and the suffix with the other: both must cover the
// lens. The mean of n independent points strays by √(0.5/n); taking every other Halton point instead halves the lens
// and strays by 0.4.
TEST(LensSamples, prefixesAndSuffixesAreWellSpread) {
    const std::vector<LensSample> samples = lensSamples(Lens{}, 64, 0);
    for (std::size_t cut = 16; cut <= 48; cut += 4) {
        glm::dvec2 prefix(0);
        glm::dvec2 suffix(0);
        for (std::size_t i = 0; i < 64; ++i) (i < cut ? prefix : suffix) += glm::dvec2(samples[i].lens);
        EXPECT_LT(std::hypot(prefix.x, prefix.y) / double(cut), std::sqrt(0.5 / double(cut))) << cut;
        EXPECT_LT(std::hypot(suffix.x, suffix.y) / double(64 - cut), std::sqrt(0.5 / double(64 - cut))) << cut;
    }
}

TEST(LensSamples, seedsGiveOtherPointsOfTheSameShape) {
    EXPECT_NE(lensSample(Lens{}, 5, 1).lens, lensSample(Lens{}, 5, 0).lens);
    EXPECT_NE(lensSample(Lens{}, 5, 1).lens, lensSample(Lens{}, 5, 2).lens);
    EXPECT_EQ(lensSample(Lens{}, 5, 2).lens, lensSample(Lens{}, 5, 2).lens);
}

}  // namespace
}  // namespace defocus
