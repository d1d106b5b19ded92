#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "render/circular/blurred_blocks.h"

namespace defocus::engine {
namespace {

// A point becomes an ellipse. As for a uniform ellipse, the variance along each axis is a quarter of the squared
// half-axis.
TEST_F(ComplexBlurs, aPointBecomesAnOvalOfItsAxes) {
    Image point = filled(4, 0);
    point.at(48, 40)[0] = 1000;
    for (const auto& [across, upwards] : {std::pair(0.5, 1.0), std::pair(1.0, 0.4)}) {
        ComplexBlurInfo info = infoOf(5);
        info.across = across;
        info.upwards = upwards;
        const Image image = blurred(info, point, filled(1, 24));
        double energy = 0;
        glm::dvec2 moment(0);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                energy += *image.at(x, y);
                moment += double(*image.at(x, y)) * glm::dvec2(std::pow(x - 48, 2), std::pow(y - 40, 2));
            }
        EXPECT_NEAR(energy, 1000, 1000 * 0.01);
        EXPECT_NEAR(2 * std::sqrt(moment.x / energy), 24 * across, 1);
        EXPECT_NEAR(2 * std::sqrt(moment.y / energy), 24 * upwards, 1);
    }
}

TEST_F(ComplexBlurs, aConstantStaysConstantHoweverTheRadiusVaries) {
    Image varying(width, height, 1);
    for (int y = 0; y < height; ++y)  // the blur radius grows along x and has a step
        for (int x = 0; x < width; ++x) *varying.at(x, y) = x + y < 90 ? 0.07f * static_cast<float>(x) : 11.0f;
    for (const ComplexStorage storage : {ComplexStorage::float32, ComplexStorage::half})
        for (int components = 1; components <= circularKernelLimit; ++components) {
            // Half floats store radiance and weight with 11 significant bits, rounded or truncated. The kernel
            // amplifies the rounding error by m = Σ √(A² + B²)·(∫|F| dx)²/π, a sum over the kernel's components. F is
            // the component's one-dimensional factor, and A and B are the component's weights (circular_kernel.h). For
            // 1, 2, 3, … 9 components, m is 1.29, 1.83, 2.30, … 4.41. For n components, it is at most 1.5·√n.
            const double amplification = 1.5 * std::sqrt(components);
            const double tolerance = storage == ComplexStorage::half ? amplification * 2 * 0x1p-10 : 1e-4;
            for (const float value : {1.0f / 3, 1e-4f, 1e4f})
                for (const Image& radius : {varying, filled(1, 6.3f)}) {
                    Image field = filled(4, value);
                    for (std::size_t i = 3; i < field.pixels.size(); i += 4) field.pixels[i] = 1;
                    const Image image = blurred(infoOf(components, storage), field, radius);
                    for (std::size_t i = 0; i < image.pixels.size(); i += 4)
                        ASSERT_NEAR(image.pixels[i] / image.pixels[i + 3] / value, 1, tolerance)
                            << components << " components, " << value << ", weight " << image.pixels[i + 3];
                }
        }
}

TEST_F(ComplexBlurs, radiusZeroChangesNothing) {
    const Image image = blurred(infoOf(3, ComplexStorage::float32), blocks(), filled(1, 0));
    EXPECT_LT(largestDifference(image, blocks()), 1e-5);
}

TEST_F(ComplexBlurs, aPointBecomesADiskOfTheRadiusAndKeepsItsEnergy) {
    Image point = filled(4, 0);
    point.at(48, 40)[0] = 1000;
    for (const float radius : {4.0f, 11.5f, 24.0f}) {
        const Image image = blurred(infoOf(5), point, filled(1, radius));
        double energy = 0;
        double moment = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double value = *image.at(x, y);
                energy += value;
                moment += value * (std::pow(x - 48, 2) + std::pow(y - 40, 2));
            }
        EXPECT_NEAR(energy, 1000, 1000 * 0.01);
        EXPECT_NEAR(std::sqrt(2 * moment / energy), radius, 1);  // the second moment of a disk of radius R is R²/2
    }
}

TEST_F(ComplexBlurs, bracketsLoseLittleMoreThanTheirTenBits) {
    Image bright = blocks();
    for (std::size_t i = 0; i < bright.pixels.size(); ++i)
        if (i % 4 != 3) bright.pixels[i] *= 50;  // above 1, but not clipped: 10-bit storage is relative to the max
    for (const int components : {1, 2, 3}) {
        const Image exact = blurred(infoOf(components, ComplexStorage::float32), bright, filled(1, 9));
        const Image stored = blurred(infoOf(components, ComplexStorage::rgb10A2), bright, filled(1, 9));
        double max = 0;
        for (int c = 0; c < 4; ++c) {
            double worst = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    worst = std::max<double>(worst, std::abs(exact.at(x, y)[c] - stored.at(x, y)[c]));
            max = std::max(max, c == 3 ? worst : worst / 50);
        }
        EXPECT_GT(max, 1e-6);
        EXPECT_LT(max, 0.03) << components;
    }
}

// Radiance and weights are divided by their max before they are rounded to 10 bits, so small weights keep their
// relative precision.
TEST_F(ComplexBlurs, bracketsKeepSmallWeights) {
    Image light = blocks();
    for (float& value : light.pixels) value *= 0.01f;
    const Image one = blurred(infoOf(2, ComplexStorage::rgb10A2), blocks(), filled(1, 9));
    const Image small = blurred(infoOf(2, ComplexStorage::rgb10A2), light, filled(1, 9));
    for (std::size_t i = 0; i < one.pixels.size(); ++i) ASSERT_NEAR(small.pixels[i] / 0.01f, one.pixels[i], 5e-3) << i;
}

// The published bracket (storage range) of a kernel with a radius of eight taps scales values by the sum of the taps. A
// white field is stored as 1, a black field as 0 and every other field in between.
TEST(Brackets, ofEightTapsStoreAWhiteFieldAsOne) {
    for (int n = 1; n <= circularKernelLimit; ++n)
        for (const CircularComponent& component : circularKernel(n)) {
            const ComplexBracket bracket = bracketOf(component, ComplexTaps::eight);
            std::complex<double> sum = 0;
            for (int i = -8; i <= 8; ++i) {
                const std::complex<double> tap = circularFactor(component, i / 8.0);
                EXPECT_GE(tap.real(), bracket.real.offset - 1e-12);
                EXPECT_GE(tap.imag(), bracket.imaginary.offset - 1e-12);
                sum += tap / 17.0;
            }
            EXPECT_NEAR((sum.real() - bracket.real.offset) / bracket.real.scale, 1, 1e-12);
            EXPECT_NEAR((sum.imag() - bracket.imaginary.offset) / bracket.imaginary.scale, 1, 1e-12);
        }
}

// Brackets (storage ranges) of the published kernel of two components, for a radius of eight taps, equal those that
// Garcia's filter generator prints. The generator scales the kernel to a sum of one, so the middle tap is 0.064754
// instead of 1.
TEST(Brackets, ofEightTapsAreGarcias) {
    constexpr double middle = 0.064754;
    constexpr int taps = 17;
    const auto expectBracket = [&](const Bracket& bracket, double offset, double scale) {
        EXPECT_NEAR(bracket.offset * middle, offset, 2e-6);
        EXPECT_NEAR(bracket.scale * middle * taps, scale, 2e-5);
    };
    const auto kernel = circularKernel(2, KernelConstants::published);
    const ComplexBracket first = bracketOf(kernel[0], ComplexTaps::eight);
    expectBracket(first.real, -0.038708, 0.943062);
    expectBracket(first.imaginary, -0.025574, 0.660892);
    const ComplexBracket second = bracketOf(kernel[1], ComplexTaps::eight);
    expectBracket(second.real, 0.000115, 0.559524);
    expectBracket(second.imaginary, 0, 0.178226);
}

TEST(Brackets, boundTheTapsOfEveryRadius) {
    const auto expectWithin = [](double tap, const Bracket& bracket) {
        EXPECT_GE(tap, bracket.offset - 1e-4);
        EXPECT_LE(tap, bracket.offset + bracket.scale + 1e-4);
    };
    for (int n = 1; n <= circularKernelLimit; ++n)
        for (const CircularComponent& component : circularKernel(n)) {
            const ComplexBracket bracket = bracketOf(component, ComplexTaps::exact);
            for (const double radius : {0.51, 1.3, 5.05, 17.71, 160.3})
                for (int i = 0; i < radius + 0.5; ++i) {
                    const std::complex<double> tap = circularFactor(component, i / radius);
                    expectWithin(tap.real(), bracket.real);
                    expectWithin(tap.imag(), bracket.imaginary);
                }
        }
}

// A bracket maps a sum of taps to [0, 1], the range in which it is stored. A published bracket maps a white field to 1.
// If the taps depend on the radius, the bracket spans all possible sums, and a white field reaches only about 1/2. With
// ten bits, published brackets therefore lose less precision.
TEST_F(ComplexBlurs, publishedBracketsLoseLessThanRanges) {
    const auto lost = [&](ComplexTaps taps) {
        ComplexBlurInfo info = infoOf(2, ComplexStorage::float32);
        info.taps = taps;
        info.constants = KernelConstants::published;
        const Image exact = blurred(info, blocks(), filled(1, 8));
        info.storage = ComplexStorage::rgb10A2;
        return largestDifference(exact, blurred(info, blocks(), filled(1, 8)));
    };
    EXPECT_LT(lost(ComplexTaps::eight), 0.7 * lost(ComplexTaps::exact));
}

}  // namespace
}  // namespace defocus::engine
