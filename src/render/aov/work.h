#pragma once
// The rasterization work of a frame: the number of triangles that touch each pixel over all lens samples. Such heat
// maps are in Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Figure 7.

#include <filesystem>

#include "gl/target.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

// Computes renderWork() as a texture, a few lens samples at a time, for successive frames of one world. Needs a current
// GL context.
class WorkPass {
public:
    // `world` must outlive the pass.
    explicit WorkPass(const World& world, std::filesystem::path shaderFolder = {});

    // Clears the sum and prepares the frame; draws nothing.
    void begin(const FramePlan& plan);
    // Adds further samples of the plan for about `milliseconds`. Returns false once all samples are added.
    bool grow(double milliseconds);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }  // number of samples in the sum
    // Triangles per pixel, summed over samples() lens samples: r32f, row 0 at the bottom.
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

// Returns a one-channel image that counts, in each lens sample, the triangles that cover the pixel's centre. Hidden
// triangles and those that fail the alpha test count too; culled back faces do not. This is the work of the
// accumulation without the sky. Counts are exact up to 16.7 million per pixel. Needs a current GL context.
Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Triangles per lens sample at which the colour map saturates.
inline constexpr float maxShownWork = 15;

// Returns the work over `samples` lens samples as colours (magma) that compare between frames. Pixels without triangles
// are black; 1, 3, 7 and 15 triangles per lens sample are purple, red, orange and pale yellow.
Image workColourMap(const Image& work, std::uint32_t samples);

struct WorkSummary {
    double mean = 0;  // triangles per pixel and lens sample
    double max = 0;   // the same in the pixel with the highest count
};

WorkSummary workSummary(const Image& work, std::uint32_t samples);

}  // namespace defocus::engine
