// van der Corput 1935 and Halton 1960 (radical inverse); Shirley and Chiu 1997, A Low Distortion Map Between Disk and
// Square.

#include "lens/lens_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace defocus {

namespace {

constexpr std::array<std::uint32_t, 4> bases = {2, 3, 5, 7};  // lens r, lens s, pixel x, pixel y
constexpr double beforeOne = 1.0 - 0x1p-32;

double fraction(double value) {
    return std::min(value - std::floor(value), beforeOne);
}

// A well mixed 32-bit value of (seed, dimension), as a shift in [0, 1); seed 0 shifts by nothing.
double seedShift(std::uint32_t seed, std::uint32_t dimension) {
    if (seed == 0) return 0;
    std::uint32_t hash = seed * 0x9e3779b9u + dimension * 0x85ebca6bu;  // the finaliser of MurmurHash3 (Appleby)
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
    return (hash ^ (hash >> 16)) * 0x1p-32;
}

// Dimension `dimension` of point `index` (from 0): Halton point index + 1, shifted so that index 0 lies at 1/2.
double shiftedHalton(std::uint64_t index, std::uint32_t dimension, std::uint32_t seed) {
    const std::uint32_t base = bases[dimension];
    return fraction(radicalInverse(base, index + 1) - 1.0 / base + 0.5 + seedShift(seed, dimension));
}

// A point of the triangle between the centre and the blade from `angle` to `angle + width` on the unit circle.
glm::dvec2 bladePoint(double angle, double width, double s, double t) {
    const double radius = std::sqrt(s);
    const glm::dvec2 first(std::cos(angle), std::sin(angle));
    const glm::dvec2 second(std::cos(angle + width), std::sin(angle + width));
    return radius * ((1 - t) * first + t * second);
}

}  // namespace

double radicalInverse(std::uint32_t base, std::uint64_t index) {
    const double inverseBase = 1.0 / base;
    double weight = inverseBase;
    double result = 0;
    for (; index > 0; index /= base, weight *= inverseBase) result += static_cast<double>(index % base) * weight;
    return std::min(result, beforeOne);
}

glm::dvec2 concentricDisk(const glm::dvec2& square) {
    const glm::dvec2 offset = 2.0 * square - 1.0;
    if (offset.x == 0 && offset.y == 0) return offset;
    constexpr double quarter = std::numbers::pi / 4;
    if (std::abs(offset.x) > std::abs(offset.y)) {
        const double angle = quarter * (offset.y / offset.x);
        return offset.x * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    const double angle = 2 * quarter - quarter * (offset.x / offset.y);
    return offset.y * glm::dvec2(std::cos(angle), std::sin(angle));
}

glm::dvec2 apertureSample(const Lens& lens, const glm::dvec2& square) {
    glm::dvec2 point = concentricDisk(square);
    if (lens.bladeCount >= 3) {
        // The disk point's angle and area fraction pick the blade and the place in it, so that the centre stays the
        // centre and the sequence stays well spread.
        const double blades = lens.bladeCount;
        const double turn = fraction(std::atan2(point.y, point.x) / (2 * std::numbers::pi)) * blades;
        const double blade = std::floor(turn);
        const double width = 2 * std::numbers::pi / blades;
        point =
            bladePoint(blade * width + lens.bladeRotation, width, point.x * point.x + point.y * point.y, turn - blade);
    }
    const double ratio = lens.anamorphicRatio;
    return {ratio > 1 ? point.x / ratio : point.x, ratio < 1 ? point.y * ratio : point.y};
}

LensSample lensSample(const Lens& lens, std::uint64_t index, std::uint32_t seed) {
    const glm::dvec2 aperture(shiftedHalton(index, 0, seed), shiftedHalton(index, 1, seed));
    const glm::dvec2 pixel(shiftedHalton(index, 2, seed), shiftedHalton(index, 3, seed));
    return {glm::vec2(apertureSample(lens, aperture)), glm::vec2(pixel - 0.5)};
}

std::vector<LensSample> lensSamples(const Lens& lens, std::uint32_t count, std::uint32_t seed) {
    std::vector<LensSample> samples(count);
    for (std::uint32_t i = 0; i < count; ++i) samples[i] = lensSample(lens, i, seed);
    return samples;
}

}  // namespace defocus
