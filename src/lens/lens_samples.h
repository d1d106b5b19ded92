#pragma once
// The points on the lens and in the pixel that the accumulation visits: pure functions of the sample index.
//
// Halton bases 2 and 3 (index from 1) on the lens, bases 5 and 7 inside the pixel. A Halton prefix of length N has a
// mean of about 1/2 − 1/(2N) in base 2; a toroidal shift per dimension puts the first sample at the centre of lens and
// pixel, so that N = 1 is the pinhole image.

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "lens/lens.h"

namespace defocus {

// Radical inverse of `index` in `base` (van der Corput 1935; Halton 1960), in [0, 1).
double radicalInverse(std::uint32_t base, std::uint64_t index);

// (r, s) ∈ [0, 1)² → the unit disk, area preserving and continuous (Shirley and Chiu 1997).
glm::dvec2 concentricDisk(const glm::dvec2& square);

// (r, s) ∈ [0, 1)² → the lens's aperture, inscribed in the unit disk: disk or polygon, rotation, anamorphic ratio.
// Uniform density over the shape.
glm::dvec2 apertureSample(const Lens& lens, const glm::dvec2& square);

struct LensSample {
    glm::vec2 lens{0.0f};   // (u, v) in the unit disk; +u right, +v up
    glm::vec2 pixel{0.0f};  // offset from the pixel centre in px, each in [−0.5, 0.5); +x right, +y up
};

// Sample `index` of the sequence that `seed` picks (0: the plain shifted Halton points; others: another toroidal
// shift).
LensSample lensSample(const Lens& lens, std::uint64_t index, std::uint32_t seed);

std::vector<LensSample> lensSamples(const Lens& lens, std::uint32_t count, std::uint32_t seed);

}  // namespace defocus
