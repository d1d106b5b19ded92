// Sources: van der Corput 1935 and Halton 1960 (radical inverse); Sobol' 1967; Joe and Kuo 2008, Constructing Sobol
// Sequences with Better Two-Dimensional Projections; Owen 1995, Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences;
// Burley 2020, Practical Hash-Based Owen Scrambling; Roberts 2018, The Unreasonable Effectiveness of Quasirandom
// Sequences.

#include "lens/lens_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/enum_name.h"
#include "core/hash.h"

namespace defocus::engine {

namespace {

// Dimensions of a sample: two on the lens, pixel x and y, time, chromatic band, and two on the lights.
constexpr std::size_t dimensionCount = 8;
using Coordinates = std::array<double, dimensionCount>;

constexpr double beforeOne = 1.0 - 0x1p-32;

double fraction(double value) {
    return std::min(value - std::floor(value), beforeOne);
}

std::uint32_t hashOf(std::uint32_t a, std::uint32_t b) {
    return fmix32(a * 0x9e3779b9u + fmix32(b + 0x7f4a7c15u));
}

// Returns a pseudo-random shift in [0, 1) for (seed, dimension); 0 for seed 0.
double seedShift(std::uint32_t seed, std::size_t dimension) {
    if (seed == 0) return 0;
    return fmix32(seed * 0x9e3779b9u + static_cast<std::uint32_t>(dimension) * 0x85ebca6bu) * 0x1p-32;
}

// ---- Halton ---------------------------------------------------------------------------------------------------------

constexpr std::array<std::uint32_t, dimensionCount> bases = {2, 3, 5, 7, 11, 13, 17, 19};

// Returns a coordinate of Halton point number index + 1, shifted modulo 1. Halton point number 0, a corner of the unit
// cube, is not used. With seed 0, the shift moves the first point that is used to the centre of the cube.
double shiftedHalton(std::uint64_t index, std::size_t dimension, std::uint32_t seed) {
    const std::uint32_t base = bases[dimension];
    return fraction(radicalInverse(base, index + 1) - 1.0 / base + 0.5 + seedShift(seed, dimension));
}

// Returns the value of `digit` under a random permutation of the digits 0 … base − 1 (Fisher–Yates shuffle). The
// permutation depends on `before`, a hash of the preceding digits.
std::uint32_t permuted(std::uint32_t base, std::uint32_t digit, std::uint32_t before) {
    std::array<std::uint32_t, bases.back()> digits{};
    std::iota(digits.begin(), digits.begin() + base, 0u);
    for (std::uint32_t i = base - 1; i > 0; --i) std::swap(digits[i], digits[hashOf(before, i) % (i + 1)]);
    return digits[digit];
}

// Returns the Owen-scrambled radical inverse. With seed 0, each digit is then shifted modulo the base, by the same
// amount in all points, so that index 0 gives 1/2: 0.1000… in base 2, 0.1111… in base 3, 0.2222… in base 5. Unlike a
// shift of the value modulo 1, this preserves the number of points in each elementary interval.
double scrambledHalton(std::uint64_t index, std::size_t dimension, std::uint32_t seed) {
    const std::uint32_t base = bases[dimension];
    std::uint32_t before = hashOf(seed, static_cast<std::uint32_t>(dimension));
    std::uint32_t beforeOfZero = before;
    double weight = 1.0 / base;
    double result = 0;
    for (int place = 0; weight > 0x1p-34; ++place, index /= base, weight /= base) {
        const auto digit = static_cast<std::uint32_t>(index % base);
        std::uint32_t turn = 0;
        if (seed == 0) {
            const std::uint32_t middle = base > 2 ? base / 2 : place == 0 ? 1 : 0;
            turn = middle + base - permuted(base, 0, beforeOfZero);
        }
        result += (permuted(base, digit, before) + turn) % base * weight;
        before = hashOf(before, digit);
        beforeOfZero = hashOf(beforeOfZero, 0);
    }
    return std::min(result, beforeOne);
}

// ---- Sobol ----------------------------------------------------------------------------------------------------------

std::uint32_t reversedBits(std::uint32_t x) {
    x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    return (x << 16) | (x >> 16);
}

// Returns the Owen-scrambled 32-bit fraction. Each bit is flipped by a hash of the higher bits. The bits are hashed one
// by one, because hashes that scramble all bits at once leave visible patterns.
std::uint32_t owenScrambled(std::uint32_t x, std::uint32_t seed) {
    std::uint32_t flips = 0;
    std::uint32_t before = seed;
    for (std::uint32_t bit = 1u << 31; bit != 0; bit >>= 1) {
        before = hashOf(before, (x & bit << 1) != 0 ? 1 : 0);
        if ((before & 0x10000u) != 0) flips |= bit;
    }
    return x ^ flips;
}

// Primitive polynomial modulo 2 and its first direction numbers, as listed by Joe and Kuo.
struct Direction {
    std::uint32_t degree = 0;
    std::uint32_t coefficients = 0;  // bits: coefficients of x^(degree − 1) … x, highest power first
    std::array<std::uint32_t, 5> first{};
};

using Columns = std::array<std::uint32_t, 32>;  // columns of a generator matrix; the top bit is the first binary digit

constexpr Columns columnsOf(const Direction& direction) {
    Columns columns{};
    const std::uint32_t degree = direction.degree;
    for (std::uint32_t i = 0; i < 32; ++i) {
        if (i < degree) {
            columns[i] = direction.first[i] << (31 - i);
            continue;
        }
        columns[i] = columns[i - degree] ^ columns[i - degree] >> degree;
        for (std::uint32_t k = 1; k < degree; ++k)
            if ((direction.coefficients >> (degree - 1 - k) & 1u) != 0) columns[i] ^= columns[i - k];
    }
    return columns;
}

// Generator matrices of dimensions 2 to 8. Dimension 1 is the bit-reversed index.
constexpr std::array<Columns, dimensionCount - 1> sobolColumns = {columnsOf({1, 0, {1}}),
                                                                  columnsOf({2, 1, {1, 3}}),
                                                                  columnsOf({3, 1, {1, 3, 1}}),
                                                                  columnsOf({3, 2, {1, 1, 1}}),
                                                                  columnsOf({4, 1, {1, 1, 3, 3}}),
                                                                  columnsOf({4, 4, {1, 3, 5, 13}}),
                                                                  columnsOf({5, 2, {1, 1, 5, 5, 17}})};

std::uint32_t sobol(std::uint32_t index, std::size_t dimension) {
    if (dimension == 0) return reversedBits(index);
    std::uint32_t result = 0;
    for (std::size_t i = 0; index != 0; ++i, index >>= 1)
        if ((index & 1u) != 0) result ^= sobolColumns[dimension - 1][i];
    return result;
}

// Scrambling constant for seed 0, the best of 3,000 candidates. A half plane cuts off a part of the lens, and the
// fraction of points in this part approximates its area. The constant minimises the error of this approximation for the
// first 8 to 256 points, and for every prefix and suffix of the first 64 points.
constexpr std::uint32_t chosenScramble = 935;

// Returns a coordinate of a scrambled Sobol point. With seed 0, the same bits are flipped in all points, so that the
// coordinates of point 0 become 1/2.
double scrambledSobol(std::uint32_t index, std::size_t dimension, std::uint32_t seed) {
    const std::uint32_t stream = hashOf(seed == 0 ? chosenScramble : seed, 100 + static_cast<std::uint32_t>(dimension));
    const std::uint32_t flips = seed == 0 ? owenScrambled(0, stream) ^ 1u << 31 : 0;
    return (owenScrambled(sobol(index, dimension), stream) ^ flips) * 0x1p-32;
}

// ---- additive recurrences -------------------------------------------------------------------------------------------

// Steps of additive recurrences (Roberts 2018). The real root of x^(d + 1) = x + 1 gives the steps x⁻¹ … x⁻ᵈ of d
// dimensions. The lens uses d = 2. The pixel uses the last two of d = 4, so that its points are independent of the lens
// points. Time uses the golden ratio, the chromatic band √2, and the lights the last two of d = 6.
constexpr double plastic2 = 1.32471795724474602596;
constexpr double plastic4 = 1.16730397826141868426;
constexpr double plastic6 = 1.11277568427870547063;
constexpr Coordinates r2Steps = {1 / plastic2,
                                 1 / (plastic2 * plastic2),
                                 1 / (plastic4 * plastic4 * plastic4),
                                 1 / (plastic4 * plastic4 * plastic4 * plastic4),
                                 0.61803398874989484820,
                                 0.41421356237309504880,
                                 1 / (plastic6 * plastic6 * plastic6 * plastic6 * plastic6),
                                 1 / (plastic6 * plastic6 * plastic6 * plastic6 * plastic6 * plastic6)};

// Converts to float; clamps values that would round to 1 to the largest float below 1.
float belowOne(double value) {
    return std::min(static_cast<float>(value), 0x1.fffffep-1f);
}

}  // namespace

std::string_view sequenceName(Sequence sequence) {
    return enumName<Sequence::r2>(sequence, {"halton", "scrambled-halton", "sobol", "r2"});
}

SequencePoint sequencePoint(Sequence sequence, std::uint64_t index, std::uint32_t seed) {
    Coordinates at{};
    for (std::size_t i = 0; i < dimensionCount; ++i) {
        if (sequence == Sequence::halton) at[i] = shiftedHalton(index, i, seed);
        if (sequence == Sequence::scrambledHalton) at[i] = scrambledHalton(index, i, seed);
        if (sequence == Sequence::sobol) at[i] = scrambledSobol(static_cast<std::uint32_t>(index), i, seed);
        if (sequence == Sequence::r2)
            at[i] = fraction(static_cast<double>(index) * r2Steps[i] + 0.5 + seedShift(seed, i));
    }
    return {{at[0], at[1]}, {at[2], at[3]}, at[4], at[5], {at[6], at[7]}};
}

double radicalInverse(std::uint32_t base, std::uint64_t index) {
    const double inverseBase = 1.0 / base;
    double weight = inverseBase;
    double result = 0;
    for (; index > 0; index /= base, weight *= inverseBase) result += static_cast<double>(index % base) * weight;
    return std::min(result, beforeOne);
}

LensSample lensSample(const Aperture& aperture, Sequence sequence, std::uint64_t index, std::uint32_t seed) {
    const SequencePoint point = sequencePoint(sequence, index, seed);
    const glm::vec2 pixel(belowOne(point.pixel.x), belowOne(point.pixel.y));
    const glm::vec2 light(belowOne(point.light.x), belowOne(point.light.y));
    return {glm::vec2(apertureSample(aperture, point.lens)),
            pixel - 0.5f,
            belowOne(point.time),
            belowOne(point.band),
            light,
            static_cast<std::uint32_t>(index)};
}

std::vector<LensSample> lensSamples(const Lens& lens, Sequence sequence, std::uint64_t first, std::uint32_t count,
                                    std::uint32_t seed) {
    const Aperture aperture = makeAperture(lens);
    std::vector<LensSample> samples(count);
    for (std::uint32_t i = 0; i < count; ++i) samples[i] = lensSample(aperture, sequence, first + i, seed);
    return samples;
}

}  // namespace defocus::engine
