#pragma once
// The rays of each pixel of the lens-space methods. There are several sets of rays, called variants, which alternate
// between neighbouring pixels (shaders/lens_space/rays.glsl). The error of few rays then looks like fine noise instead
// of overlaid images.
//
// The sets are successive pieces of the sample sequence that the accumulation uses. Each set is thus well distributed
// over the lens (of any shape), the pixel and time. In each set the lens is bisected repeatedly, by width, by height
// and so on, until one ray is left per part. Ray i of all sets then passes through nearly the same small part of the
// lens; the tile tests use its bounds (Munkberg, Toth and Akenine-Möller 2012, Section 4). The parts are visited in an
// order that also spreads the first rays. If the exposure has several parts, a set is first divided among them by time.
// Taking every other ray of a set instead would take the same side of each pair of the last bisection.

#include <glm/vec4.hpp>

#include "plan/frame_plan.h"

namespace defocus::engine {

// A ray in the layout of shaders/lens_space/rays.glsl.
struct GpuRay {
    glm::vec4 lensAndPixel{0};
    glm::vec4 values{0};
};

struct RaySets {
    std::uint32_t rays = 0;             // rays per pixel
    std::uint32_t variants = 1;         // a power of two, at most 64
    std::vector<GpuRay> table;          // index: ray · variants + variant
    std::vector<glm::vec4> lensBounds;  // per ray, over its variants: min u, min k·v, max u, max k·v
};

// Returns the number of variants for sets of `rays` rays: up to 64, and fewer (at least 4) to keep the total near
// 262,144 rays.
std::uint32_t variantCount(std::uint32_t rays);

// Returns the index of the first of `total` rays in part `part` of the exposure, which has `parts` parts of equal
// length.
std::uint32_t firstRayOfPart(std::uint32_t part, std::uint32_t parts, std::uint32_t total);

// Returns sets with one ray per sample of the plan. All rays pass through the lens centre if the plan ignores the lens.
// The rays of each of the exposure's `parts` are contiguous and well distributed over lens and pixel. Their time is
// relative to their part.
RaySets pointRaySets(const FramePlan& plan, std::uint32_t parts);

// Returns an order of visiting `count` parts in a row in which any first parts are spread over the row (van der Corput
// 1935).
std::vector<std::uint32_t> spreadOrder(std::uint32_t count);

}  // namespace defocus::engine
