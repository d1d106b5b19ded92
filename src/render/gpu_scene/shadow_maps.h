#pragma once
// The shadow maps of a wave of lens samples (plan/shadows.h): a layer for each sample, point and map, drawn by a
// surface pass of its own from the levels that the plan chose.

#include <optional>

#include "gl/target.h"
#include "plan/visible/shadows.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

class ShadowMaps {
public:
    // Needs a current GL context.
    ShadowMaps(GpuScene& scene, bool vertexShaderLayers, std::filesystem::path shaderFolder);

    // For the samples of `plan`, which may have no shadows. `frame` was uploaded for it, and must outlive the drawing.
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Draws the maps of samples [first, first + count), one wave; the render target is another one then.
    void draw(std::uint32_t first, std::uint32_t count);
    // What shaders that read the maps need; empty without shadows.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // For drawing a sample, and what follows it in its wave, with such a shader.
    void bind(std::uint32_t sample) const;
    [[nodiscard]] std::size_t bytes() const { return maps_.bytes() + projections_.bytes() + casters_.bytes(); }

private:
    GpuScene* scene_;
    SurfacePass casters_;
    const FrameUniforms* frame_ = nullptr;
    EnvironmentDirections directions_;
    const Image* directionsOf_ = nullptr;  // the map that they are of, if it is one
    FramePlan plan_;                       // of the casters
    ShaderDefines defines_;
    TexelBuffer projections_;
    GlTexture maps_;
    Target target_;
};

// Bytes of the maps of one lens sample.
std::uint64_t shadowMapBytes(const FramePlan& plan);

}  // namespace defocus::engine
