#include "lens/lens_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace defocus::engine {
namespace {

std::vector<LensSample> samplesOf(const Lens& lens, std::uint32_t count, Sequence sequence = Sequence::sobol) {
    return lensSamples(lens, sequence, 0, count, 0);
}

TEST(LensSamples, firstSampleIsThePinholeInTheMiddleOfTheShutter) {
    for (const Sequence sequence : allSequences)
        for (const int blades : {0, 3, 6}) {
            const Lens lens{
                .bladeCount = blades, .bladeCurvature = 0.4, .sphericalAberration = blades == 6 ? 1.0 : 0.0};
            const LensSample sample = samplesOf(lens, 1, sequence).front();
            EXPECT_NEAR(sample.lens.x, 0, 1e-4) << sequenceName(sequence);
            EXPECT_NEAR(sample.lens.y, 0, 1e-4) << sequenceName(sequence);
            EXPECT_NEAR(sample.pixel.x, 0, 1e-7) << sequenceName(sequence);
            EXPECT_NEAR(sample.pixel.y, 0, 1e-7) << sequenceName(sequence);
            EXPECT_NEAR(sample.time, 0.5, 1e-7) << sequenceName(sequence);
            EXPECT_NEAR(sample.band, 0.5, 1e-7) << sequenceName(sequence);
        }
}

TEST(LensSamples, fillLensPixelTimeAndBandEvenly) {
    for (const Sequence sequence : allSequences) {
        int pixels[4] = {};
        int times[4] = {};
        int bands[4] = {};
        for (const LensSample& sample : samplesOf(Lens{}, 4096, sequence)) {
            ASSERT_LE(glm::dot(sample.lens, sample.lens), 1 + 1e-6f);
            for (int c = 0; c < 2; ++c) {
                ASSERT_GE(sample.pixel[c], -0.5f);
                ASSERT_LT(sample.pixel[c], 0.5f);
            }
            ASSERT_GE(std::min(sample.time, sample.band), 0.0f);
            ASSERT_LT(std::max(sample.time, sample.band), 1.0f);
            ++pixels[(sample.pixel.x < 0 ? 0 : 1) + (sample.pixel.y < 0 ? 0 : 2)];
            ++times[static_cast<int>(sample.time * 4)];
            ++bands[static_cast<int>(sample.band * 4)];
        }
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(pixels[i], 1024, 12) << sequenceName(sequence);
            EXPECT_NEAR(times[i], 1024, 12) << sequenceName(sequence);
            EXPECT_NEAR(bands[i], 1024, 12) << sequenceName(sequence);
        }
    }
}

// Within each eighth of the exposure time and of the wavelength range, 64 of 512 samples still cover the lens. Their
// mean is closer to the lens centre than √(0.5/64), the RMS distance for independent points.
TEST(LensSamples, everyPartOfTimeAndBandSeesAllOfTheLens) {
    for (const Sequence sequence : allSequences) {
        glm::dvec2 times[8] = {};
        glm::dvec2 bands[8] = {};
        for (const LensSample& sample : samplesOf(Lens{}, 512, sequence)) {
            times[static_cast<int>(sample.time * 8)] += glm::dvec2(sample.lens) / 64.0;
            bands[static_cast<int>(sample.band * 8)] += glm::dvec2(sample.lens) / 64.0;
        }
        for (int i = 0; i < 8; ++i) {
            EXPECT_LT(glm::length(times[i]), std::sqrt(0.5 / 64)) << sequenceName(sequence) << i;
            EXPECT_LT(glm::length(bands[i]), std::sqrt(0.5 / 64)) << sequenceName(sequence) << i;
        }
    }
}

TEST(LensSamples, rangesAreThoseOfTheWholeSequence) {
    for (const Sequence sequence : allSequences) {
        const std::vector<LensSample> all = lensSamples(Lens{}, sequence, 0, 200, 3);
        const std::vector<LensSample> part = lensSamples(Lens{}, sequence, 128, 64, 3);
        for (std::size_t i = 0; i < part.size(); ++i) {
            EXPECT_EQ(part[i].lens, all[128 + i].lens);
            EXPECT_EQ(part[i].pixel, all[128 + i].pixel);
            EXPECT_EQ(part[i].time, all[128 + i].time);
        }
    }
}

TEST(LensSamples, seedsGiveOtherPointsOfTheSameShape) {
    const Aperture disk = makeAperture(Lens{});
    for (const Sequence sequence : allSequences) {
        EXPECT_NE(lensSample(disk, sequence, 5, 1).lens, lensSample(disk, sequence, 5, 0).lens);
        EXPECT_NE(lensSample(disk, sequence, 5, 1).lens, lensSample(disk, sequence, 5, 2).lens);
        EXPECT_EQ(lensSample(disk, sequence, 5, 2).lens, lensSample(disk, sequence, 5, 2).lens);
    }
}

}  // namespace
}  // namespace defocus::engine
