#pragma once
// Estimates the work of a stochastic rasterizer, which tests a triangle at each pixel within reach of the triangle's
// blur and motion. The work of a pixel is the number of triangles whose bounds over lens and exposure cover the pixel.
// Source: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Figure 7.

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns a one-channel image with the number of triangles per pixel. A triangle counts in all pixels that its bounding
// rectangle overlaps, over all lens points and times. A triangle that reaches the near plane counts in all pixels. A
// triangle that faces away from the entire lens counts in no pixel. A level that only some samples draw is weighted by
// the fraction of these samples.
Image sweptWork(const FramePlan& plan, const World& world);

// Number of triangles per pixel at which the colour map reaches its brightest colour.
inline constexpr float maxShownSweptWork = 16383;

// Returns the work in the magma colour map on a logarithmic scale; pixels without work are black.
Image sweptWorkColourMap(const Image& work);

}  // namespace defocus::engine
