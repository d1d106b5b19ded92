#pragma once
// Computes sample points on the lens, in the pixel, in the exposure time, in the spectrum and on the lights. They
// depend only on the sample index, the sequence and the seed.
//
// The points come from sequences that fill a unit cube evenly for any number of points. The first n and the
// last n points are both well distributed, so that samples can be split between two levels of detail. With seed 0 the
// first point is 1/2 in every dimension. A single sample therefore gives the pinhole image at the middle of the
// exposure. Other seeds give other points. With `sobol` and `scrambledHalton`, each point is uniformly distributed over
// the seeds.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "defocus/settings.h"
#include "lens/aperture.h"

namespace defocus::engine {

inline constexpr std::array allSequences = {Sequence::sobol, Sequence::halton, Sequence::scrambledHalton, Sequence::r2};

// Returns the sequence's name on the command line.
std::string_view sequenceName(Sequence sequence);

struct SequencePoint {  // all components are in [0, 1)
    glm::dvec2 lens{0.5};
    glm::dvec2 pixel{0.5};
    double time = 0.5;
    double band = 0.5;
    glm::dvec2 light{0.5};
};

// Returns point `index` < 2³² of a sequence.
SequencePoint sequencePoint(Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Returns the radical inverse of `index` in `base`, in [0, 1) (van der Corput 1935; Halton 1960).
double radicalInverse(std::uint32_t base, std::uint64_t index);

struct LensSample {
    glm::vec2 lens{0.0f};     // (u, v) in the unit disk; +u right, +v up
    glm::vec2 pixel{0.0f};    // offset from the pixel centre in px, each in [−0.5, 0.5); +x right, +y up
    float time = 0.5f;        // time in [0, 1), from shutter opening to closing
    float band = 0.5f;        // position in the chromatic band, from red (0) to blue (1, exclusive)
    glm::vec2 light{0.5f};    // point in [0, 1)² on every light, for shadows (plan/visible/shadows.h)
    std::uint32_t index = 0;  // index of the sample in the sequence
};

// Returns sample `index` of a sequence. With seed 0, the first sample lies in the middle of the pixel, the exposure and
// the chromatic band. Its lens point is the lens's centre, except with a ring-shaped aperture or an aperture image.
LensSample lensSample(const Aperture& aperture, Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Returns samples [first, first + count) of a sequence.
std::vector<LensSample> lensSamples(const Lens& lens, Sequence sequence, std::uint64_t first, std::uint32_t count,
                                    std::uint32_t seed);

}  // namespace defocus::engine
