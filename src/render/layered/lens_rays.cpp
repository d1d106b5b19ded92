// Sources: Lee, Eisemann and Seidel 2010, Real-Time Lens Blur Effects and Focus Control; Decoret 2005, N-Buffers for
// Efficient Depth Map Query.

#include "render/layered/lens_rays.h"

#include <algorithm>
#include <cmath>

namespace defocus::engine {

namespace {

constexpr int extentLevels = 6;                   // number of mip levels, whose texels cover squares of 2 … 64 px
constexpr int largestSquare = 1 << extentLevels;  // side in px of the square that a texel of the last mip level covers
constexpr GLuint groupSize = 8;                   // threads per side of a work group

// Returns the width or height, in texels, of the finest mip level for an image side of `pixels` px. A texel covers a
// square of 2 px per side. The size is rounded up to complete texels of the coarsest level.
int extentTexels(int pixels) {
    return (pixels + largestSquare - 1) / largestSquare * largestSquare / 2;
}

GlTexture extentTexture(const LensRaysInfo& info) {
    return GlTexture({.format = TextureFormat::rg32f,
                      .width = extentTexels(info.width + 2 * info.border),
                      .height = extentTexels(info.height + 2 * info.border),
                      .layers = static_cast<int>(info.layers),
                      .levels = extentLevels});
}

void dispatch(int width, int height, std::uint32_t layers) {
    const auto groups = [](int size) { return (static_cast<GLuint>(size) + groupSize - 1) / groupSize; };
    glDispatchCompute(groups(width), groups(height), layers);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void bindImage(const GlTexture& texture, int level) {
    glBindImageTexture(0, texture.name(), level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RG32F);
}

}  // namespace

LensRays::LensRays(const LensRaysInfo& info)
    : info_(info),
      extents_(extentTexture(info)),
      reach_({.format = TextureFormat::rg32f,
              .width = info.width,
              .height = info.height,
              .layers = static_cast<int>(info.layers)}),
      base_({{"layered/extent.comp"}, {{"finestExtents", "true"}}, info.shaderFolder}),
      extend_({{"layered/extent.comp"}, {}, info.shaderFolder}),
      bound_({{"layered/reach.comp"}, {{"extentLevels", std::to_string(extentLevels)}}, info.shaderFolder}) {
    extents_.sampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
}

void LensRays::prepare(const FramePlan& plan, const FrameUniforms& frame) {
    frame_ = &frame;
    ShaderDefines defines = frame.defines();
    for (const auto& define : layerFormatDefines(info_.format)) defines.push_back(define);
    if (info_.blended) defines.emplace_back("blendedLayers", "true");
    if (info_.vertexShaderLayers) defines.emplace_back("VERTEX_LAYER", "");
    if (!trace_ || traceDefines_ != defines) {
        traceDefines_ = defines;
        std::vector<std::string> shaders = {"accumulation/sky.vert", "layered/trace.frag"};
        if (!info_.vertexShaderLayers) shaders.emplace_back("accumulation/sky.geom");
        trace_ = Program({std::move(shaders), std::move(defines), info_.shaderFolder});
    }
    samples_.attribute(lensLocation, 4, GL_FLOAT, false, true);
    samples_.attribute(eyeLocation, 4, GL_FLOAT, false, true);
    samples_.bind(lensLocation, frame.samples(), 0, sizeof(GpuSample));
    samples_.bind(eyeLocation, frame.samples(), sizeof(glm::vec4), sizeof(GpuSample));
    if (frame.bandShifts()) {
        samples_.attribute(bandShiftLocation, 1, GL_FLOAT, false, true);
        samples_.bind(bandShiftLocation, frame.bandShifts(), 0, sizeof(float));
    }
    const double max = std::hypot(info_.width + 2 * info_.border, info_.height + 2 * info_.border);
    const double largest = std::isfinite(plan.largestBlur) ? 0.5 * plan.largestBlur + 2 : max;
    glProgramUniform1i(bound_.name(), 0, info_.border);
    glProgramUniform1f(bound_.name(), 1, static_cast<float>(std::min(largest, max)));
    glProgramUniform1f(bound_.name(), 2, static_cast<float>(plan.coc.chromatic * plan.view.width));
    glProgramUniform1i(trace_.name(), 1, info_.border);
}

void LensRays::bound(const DepthLayers& layers) {
    if (layers.count() == 0) return;
    base_.use();
    layers.surfaces().attach(0);
    bindImage(extents_, 0);
    dispatch(extents_.info().width, extents_.info().height, layers.count());
    extend_.use();
    extents_.attach(0);
    for (int level = 1; level < extentLevels; ++level) {
        glUniform1i(0, level - 1);
        bindImage(extents_, level);
        dispatch(extents_.info().width >> level, extents_.info().height >> level, layers.count());
    }
    bound_.use();
    bindImage(reach_, 0);
    dispatch(info_.width, info_.height, layers.count());
}

void LensRays::trace(const DepthLayers& layers, const glm::vec2& pinhole, std::uint32_t first, std::uint32_t count) {
    frame_->bind(first);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    samples_.use();
    trace_.use();
    layers.colors().attach(0);
    layers.surfaces().attach(1);
    reach_.attach(2);
    glUniform1i(0, static_cast<GLint>(layers.count()));
    glUniform2f(2, pinhole.x, pinhole.y);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(count), first);
}

}  // namespace defocus::engine
