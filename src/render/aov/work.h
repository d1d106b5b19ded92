#pragma once
// Measures the rasterization work of a frame: the number of triangles that cover each pixel, summed over all lens
// samples. Source: the heat maps of Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic
// Rasterization, Figure 7.

#include <filesystem>

#include "gl/target.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

// Computes the number of triangles per pixel (see renderWork()) as a texture, a few lens samples at a time, for
// successive frames of one world. Needs a current OpenGL context.
class WorkPass {
public:
    // `world` must outlive this object.
    explicit WorkPass(const World& world, std::filesystem::path shaderFolder = {});

    // Starts a frame: clears the sum and uploads data, but draws nothing.
    void begin(const FramePlan& plan);
    // Adds further samples of the plan until about `milliseconds` have passed. Returns false once all samples are
    // added.
    bool grow(double milliseconds);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // number of lens samples in the sum
    // Returns the number of triangles that cover each pixel, summed over samples() lens samples: r32f, row 0 at the
    // bottom.
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

// Returns, for each pixel, the number of triangles that cover its centre, summed over all lens samples (1 channel).
// Hidden triangles and fragments that fail the alpha test are counted; culled back faces and the sky are not. Counts
// are exact up to 16.7 million per pixel. Needs a current OpenGL context.
Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Triangles per pixel and lens sample at which the colour map saturates.
inline constexpr float maxShownWork = 15;

// Maps the work, the number of triangles per pixel summed over `samples` lens samples, to linear RGB with the magma
// colour map. The scale is the same for all frames: 0 triangles per lens sample are black; 1, 3, 7 and 15 are purple,
// red, orange and pale yellow.
Image workColourMap(const Image& work, std::uint32_t samples);

struct WorkSummary {
    double mean = 0;  // triangles per pixel and lens sample
    double max = 0;   // max over all pixels of the triangles per lens sample
};

WorkSummary workSummary(const Image& work, std::uint32_t samples);

}  // namespace defocus::engine
