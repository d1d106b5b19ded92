#pragma once
// The points on the lens, in the pixel, in the shutter's time, in the spectrum and on the lights that the accumulation
// visits: pure functions of the sample index.
//
// They come from points that fill a unit cube evenly, however many of them are taken. A prefix and a suffix of each are
// well spread, as the split of the lens samples between two levels needs. With seed 0 the first point is the middle of
// every dimension, so that one sample is the pinhole image at the middle of the shutter; other seeds give other points,
// and with `sobol` and `scrambledHalton` each of their points is uniform over the seeds.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "defocus/settings.h"
#include "lens/aperture.h"

namespace defocus::engine {

inline constexpr std::array allSequences = {Sequence::sobol, Sequence::halton, Sequence::scrambledHalton, Sequence::r2};

// As the command line has it.
std::string_view sequenceName(Sequence sequence);

struct SequencePoint {  // each in [0, 1)
    glm::dvec2 lens{0.5};
    glm::dvec2 pixel{0.5};
    double time = 0.5;
    double band = 0.5;
    glm::dvec2 light{0.5};
};

// Point `index` < 2³².
SequencePoint sequencePoint(Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Radical inverse of `index` in `base` (van der Corput 1935; Halton 1960), in [0, 1).
double radicalInverse(std::uint32_t base, std::uint64_t index);

struct LensSample {
    glm::vec2 lens{0.0f};     // (u, v) in the unit disk; +u right, +v up
    glm::vec2 pixel{0.0f};    // offset from the pixel centre in px, each in [−0.5, 0.5); +x right, +y up
    float time = 0.5f;        // [0, 1): from the shutter's opening to its closing
    float band = 0.5f;        // [0, 1): place in the chromatic band, from red to blue
    glm::vec2 light{0.5f};    // each in [0, 1): the point of every light (plan/shadows.h) from which shadows fall
    std::uint32_t index = 0;  // in the sequence
};

// Sample `index` of a sequence. With seed 0 the first is the middle of pixel, time and band, and the lens's centre
// where its shape has one.
LensSample lensSample(const Aperture& aperture, Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Samples [first, first + count).
std::vector<LensSample> lensSamples(const Lens& lens, Sequence sequence, std::uint64_t first, std::uint32_t count,
                                    std::uint32_t seed);

}  // namespace defocus::engine
