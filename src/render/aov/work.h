#pragma once
// The work of rasterising a frame: how many triangles touch each pixel over all lens samples (the heat maps of
// Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Figure 7).

#include <filesystem>

#include "gl/target.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

// The same as renderWork below as a texture, a few lens samples at a time, for frame after frame of one world. Needs a
// current GL context.
class WorkPass {
public:
    // `world` must outlive it.
    explicit WorkPass(const World& world, std::filesystem::path shaderFolder = {});

    // Clears the sum; draws nothing yet.
    void begin(const FramePlan& plan);
    // Adds further samples of the plan for about `milliseconds`, at least some. False once all are in.
    bool grow(double milliseconds);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // in the sum
    // Triangles a pixel over samples() lens samples: r32f, row 0 at the bottom.
    [[nodiscard]] const GlTexture& work() const { return work_; }

private:
    GpuScene scene_;
    SurfacePass surfaces_;
    FrameUniforms frame_;
    GlTexture work_;
    Target target_;
    std::uint32_t samples_ = 0;
    std::uint32_t sampleTotal_ = 0;
};

// One channel: in each lens sample of the plan, a triangle that covers the pixel's centre counts one, whether or not
// another hides it and before any alpha test; triangles whose culled back shows don't. It is what the accumulation
// draws, without the sky. Exact up to 16.7 million a pixel; the number of samples drawn at once changes nothing. Needs
// a current GL context.
Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Triangles a lens sample from which on pixels look alike in the colour map.
inline constexpr float maxShownWork = 15;

// Work over `samples` lens samples as colours that a person can read and compare between frames: black where nothing
// is, then purple, red, orange and pale yellow (magma) at 1, 3, 7 and 15 triangles a lens sample.
Image workColourMap(const Image& work, std::uint32_t samples);

struct WorkSummary {
    double mean = 0;  // triangles a pixel and lens sample
    double max = 0;   // the same, of the pixel with the most
};

WorkSummary workSummary(const Image& work, std::uint32_t samples);

}  // namespace defocus::engine
