#pragma once
// The points on the lens, in the pixel, in the shutter's time and in the spectrum that the accumulation visits: pure
// functions of the sample index.

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "lens/aperture.h"
#include "lens/sequences.h"

namespace defocus {

struct LensSample {
    glm::vec2 lens{0.0f};   // (u, v) in the unit disk; +u right, +v up
    glm::vec2 pixel{0.0f};  // offset from the pixel centre in px, each in [−0.5, 0.5); +x right, +y up
    float time = 0.5f;      // [0, 1): from the shutter's opening to its closing
    float band = 0.5f;      // [0, 1): place in the chromatic band, from red to blue
};

// Sample `index` of a sequence. With seed 0 the first is the middle of pixel, time and band, and the lens's centre
// where its shape has one.
LensSample lensSample(const Aperture& aperture, Sequence sequence, std::uint64_t index, std::uint32_t seed);

// Samples [first, first + count).
std::vector<LensSample> lensSamples(const Lens& lens, Sequence sequence, std::uint64_t first, std::uint32_t count,
                                    std::uint32_t seed);

}  // namespace defocus
