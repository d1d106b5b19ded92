#pragma once
// Points that fill a unit cube evenly, however many of them are taken: pure functions of the index.
//
// A prefix and a suffix of each are well spread, as the split of the lens samples between two levels needs. With seed 0
// the first point is the middle of every dimension, so that one sample is the pinhole image at the middle of the
// shutter; other seeds give other points, and with `sobol` and `scrambledHalton` each of their points is uniform over
// the seeds.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

#include "defocus/settings.h"

namespace defocus {

inline constexpr std::array allSequences = {Sequence::sobol, Sequence::halton, Sequence::scrambledHalton, Sequence::r2};

// As the command line has it.
std::string_view sequenceName(Sequence sequence);

struct SequencePoint {  // each in [0, 1)
    glm::dvec2 lens{0.5};
    glm::dvec2 pixel{0.5};
    double time = 0.5;
    double band = 0.5;
};

// Point `index` < 2³².
SequencePoint sequencePoint(Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Radical inverse of `index` in `base` (van der Corput 1935; Halton 1960), in [0, 1).
double radicalInverse(std::uint32_t base, std::uint64_t index);

}  // namespace defocus
