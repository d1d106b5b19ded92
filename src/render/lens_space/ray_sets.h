#pragma once
// The rays of each pixel of the lens-space methods: several sets of them, the variants, at which neighbouring pixels
// take turns (shaders/lens_space/rays.glsl), so that what a few rays miss looks like fine noise instead of images that
// are laid over each other.
//
// The sets are successive pieces of the sequence that the accumulation draws its lens samples from, so that each of
// them is well spread over the lens (of any shape), the pixel and time. In each set the lens is halved again and again,
// by its width, its height and so on, until one ray is left; ray i of all sets then passes through nearly the same
// small part of the lens, whose bounds the tile tests use (Munkberg, Toth and Akenine-Möller 2012, Section 4). The
// parts are visited so that the first rays are well spread, too. Where the exposure has parts of its own, a set is
// first divided among those, by time: to take every other ray of a set would take the same side of each pair that was
// halved last.

#include <glm/vec4.hpp>

#include "plan/frame_plan.h"

namespace defocus::engine {

// A ray as shaders/lens_space/rays.glsl reads it.
struct GpuRay {
    glm::vec4 lensAndPixel{0};
    glm::vec4 values{0};
};

struct RaySets {
    std::uint32_t rays = 0;             // of a pixel
    std::uint32_t variants = 1;         // a power of two, at most 64
    std::vector<GpuRay> table;          // ray · variants + variant
    std::vector<glm::vec4> lensBounds;  // of each ray over its variants: least u and k·v, most u and k·v
};

// How many variants sets of `rays` rays have: 64, and fewer where they would be more than a quarter of a million rays.
std::uint32_t variantCount(std::uint32_t rays);

// Of `total` rays, the first that sees part `part` of the exposure, which has `parts` of equal length.
std::uint32_t firstRayOfPart(std::uint32_t part, std::uint32_t parts, std::uint32_t total);

// As many rays a pixel as the plan has samples; all pass through the lens's centre if the plan leaves out the lens. The
// rays of each of the exposure's `parts` follow each other and are well spread over lens and pixel; their time is that
// in their part.
RaySets pointRaySets(const FramePlan& plan, std::uint32_t parts);

// The order in which `count` parts in a row are visited: any number of the first are spread over the row (van der
// Corput 1935).
std::vector<std::uint32_t> spreadOrder(std::uint32_t count);

}  // namespace defocus::engine
