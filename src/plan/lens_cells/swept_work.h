#pragma once
// The work of a rasteriser that tests a triangle at each pixel which its blur or its motion may reach: how many
// triangles' bounds, swept over the lens and the exposure, cover each pixel (Munkberg, Toth and Akenine-Möller 2012,
// Per-Vertex Defocus Blur for Stochastic Rasterization, Figure 7).

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// One channel: triangles a pixel of the image. A triangle counts in all pixels that its bounding rectangle overlaps,
// over all lens points and times; one that reaches the near plane counts in all pixels, and one that shows its back to
// all of the lens in none. A level that only some samples draw counts with their share.
Image sweptWork(const FramePlan& plan, const World& world);

// Triangles a pixel from which on pixels look alike in the colour map.
inline constexpr float maxShownSweptWork = 16383;

// As colours that a person can read: black where nothing is, then brighter with the logarithm (magma).
Image sweptWorkColourMap(const Image& work);

}  // namespace defocus::engine
