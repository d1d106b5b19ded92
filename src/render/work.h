#pragma once
// The work of rasterising a frame: how many triangles touch each pixel over all lens samples (the heat maps of
// Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Figure 7).

#include <filesystem>

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus {

// One channel: in each lens sample of the plan, a triangle that covers the pixel's centre counts one, whether or not
// another hides it and before any alpha test; triangles whose culled back shows don't. It is what the accumulation
// draws, without the sky. Exact up to 16.7 million a pixel; the number of samples drawn at once changes nothing. Needs
// a current GL context.
Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Triangles a lens sample from which on pixels look alike in the colour map.
inline constexpr float mostShownWork = 15;

// Work over `samples` lens samples as colours that a person can read and compare between frames: black where nothing
// is, then purple, red, orange and pale yellow (magma) at 1, 3, 7 and 15 triangles a lens sample.
Image workColourMap(const Image& work, std::uint32_t samples);

struct WorkSummary {
    double mean = 0;  // triangles a pixel and lens sample
    double most = 0;  // the same, of the pixel with the most
};

WorkSummary workSummary(const Image& work, std::uint32_t samples);

}  // namespace defocus
