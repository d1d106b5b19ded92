#pragma once
// Draws the shadow maps of a batch (wave) of lens samples (plan/visible/shadows.h): one layer for each combination of
// sample, light point and map. The shadow casters are drawn at the levels of detail that the plan has selected.

#include <optional>

#include "gl/target.h"
#include "plan/visible/shadows.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

class ShadowMaps {
public:
    // `scene` and `pacer` must outlive this object. `pacer` must belong to the current OpenGL context.
    ShadowMaps(const GpuScene& scene, SubmissionPacer& pacer, bool vertexShaderLayers,
               std::filesystem::path shaderFolder);

    // Allocates the maps of `plan`, which may have no shadows. `frame` must hold the uniforms of `plan` and exist until
    // the last draw().
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Draws the maps of samples [first, first + count), which must be one batch (wave). Changes the render target.
    void draw(std::uint32_t first, std::uint32_t count);
    // Returns the defines that shaders need to read the maps; empty without shadows.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // Binds the maps for drawing the samples from `sample` to the end of its batch (wave). The program that reads the
    // maps must be in use.
    void bind(std::uint32_t sample) const;
    [[nodiscard]] std::size_t bytes() const {
        return maps_.bytes() + tintedMaps_.bytes() + projections_.bytes() + casters_.bytes();
    }

private:
    const GpuScene* scene_;
    SurfacePass casters_;
    const FrameUniforms* frame_ = nullptr;
    EnvironmentDirections directions_;
    const Image* directionsOf_ = nullptr;  // environment map for which directions_ was computed; null if none
    FramePlan plan_;                       // plan with only the shadow casters
    ShaderDefines defines_;
    TexelBuffer projections_;
    GlTexture maps_;
    GlTexture tintedMaps_;  // depths per colour channel; allocated if a caster tints the light
    Target target_;
};

// Returns the size in bytes of the shadow maps of one lens sample.
std::uint64_t shadowMapBytes(const Scene& scene, const FramePlan& plan);

}  // namespace defocus::engine
