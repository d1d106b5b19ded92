#pragma once
// The shadow maps of a wave of lens samples (plan/shadows.h): one layer for each sample, light point and map. A surface
// pass draws the casters at the levels that the plan chose.

#include <optional>

#include "gl/target.h"
#include "plan/visible/shadows.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

class ShadowMaps {
public:
    // Needs a current GL context.
    ShadowMaps(GpuScene& scene, bool vertexShaderLayers, std::filesystem::path shaderFolder);

    // Prepares the maps of `plan`, which may have no shadows. `frame` must hold this plan's uniforms and outlive the
    // drawing.
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Draws the maps of samples [first, first + count), which form one wave. Changes the render target.
    void draw(std::uint32_t first, std::uint32_t count);
    // Defines that shaders need to read the maps; empty without shadows.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // Binds the maps for drawing `sample` and the rest of its wave; the shader that reads them must be in use.
    void bind(std::uint32_t sample) const;
    [[nodiscard]] std::size_t bytes() const { return maps_.bytes() + projections_.bytes() + casters_.bytes(); }

private:
    GpuScene* scene_;
    SurfacePass casters_;
    const FrameUniforms* frame_ = nullptr;
    EnvironmentDirections directions_;
    const Image* directionsOf_ = nullptr;  // environment map that directions_ were computed for; null without one
    FramePlan plan_;                       // plan of the casters alone
    ShaderDefines defines_;
    TexelBuffer projections_;
    GlTexture maps_;
    Target target_;
};

// Returns the bytes of the shadow maps of one lens sample.
std::uint64_t shadowMapBytes(const FramePlan& plan);

}  // namespace defocus::engine
