#pragma once
// Chooses the rays of each pixel in the lens-space methods. Neighbouring pixels use different sets of rays, called
// variants (shaders/lens_space/rays.glsl), so that the error due to the small number of rays looks like fine noise
// instead of superimposed images.
//
// The sets are consecutive ranges of the sample sequence of method "accumulation", so each set is well distributed over
// the lens (of any shape), the pixel and time. Each set is sorted by repeated bisection of the lens, alternately in
// width and height, until each part of the lens contains one ray. Thus ray i of all sets passes through nearly the same
// small part of the lens, whose bounds the tile tests use (Munkberg, Toth and Akenine-Möller 2012, Section 4). The
// parts of the lens are visited in an order in which every prefix is evenly spread. If the exposure has several parts,
// each set is first divided among them by time.

#include <glm/vec4.hpp>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Ray through a lens point and a pixel; matches shaders/lens_space/rays.glsl.
struct GpuRay {
    glm::vec4 lensAndPixel{0};
    glm::vec4 values{0};
};

struct RaySets {
    std::uint32_t rays = 0;      // rays per pixel
    std::uint32_t variants = 1;  // number of sets, a power of two, at most 64
    std::vector<GpuRay> table;   // rays of all sets; ray i of set s has the index i · (number of sets) + s
    // Per ray, bounds of its lens points in all sets: min u, min k·v, max u, max k·v, where k = image width / height.
    std::vector<glm::vec4> lensBounds;
};

// Returns the number of variants, different sets of `rays` rays each: a power of two from 4 to 64. It is the largest
// with at most 262,144 rays in all sets together, or 4 if there is none.
std::uint32_t variantCount(std::uint32_t rays);

// Returns the index of the first ray in part `part` of an exposure with `parts` parts of equal length, for `total` rays
// per pixel.
std::uint32_t firstRayOfPart(std::uint32_t part, std::uint32_t parts, std::uint32_t total);

// Returns sets of rays with one ray per sample of the plan. Without lens blur, all rays pass through the lens centre.
// The exposure has `parts` parts; the rays of each part are contiguous and well distributed over lens and pixel, and
// their time is relative to the part.
RaySets pointRaySets(const FramePlan& plan, std::uint32_t parts);

// Returns a permutation of 0 … count − 1 such that every prefix is evenly spread (van der Corput 1935).
std::vector<std::uint32_t> spreadOrder(std::uint32_t count);

}  // namespace defocus::engine
