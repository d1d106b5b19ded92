#pragma once
// Intersects lens rays with depth layers: bounds the blurs of the surfaces that each pixel's rays may hit, and draws
// the images of lens samples.
//
// Lee, Eisemann and Seidel 2010 bound the depths that a pixel's rays may hit by N-buffers: min and max depth in squares
// around each pixel, with all powers of two as side lengths. This implementation uses mipmaps of min and max, which
// take a fifth of the memory of N-buffers and give slightly wider bounds. The mipmaps store blurs instead of depths,
// because blur controls, such as a tilted focus plane, can make the blur depend on more than the depth.

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layered/depth_layers.h"

namespace defocus::engine {

struct LensRaysInfo {
    int width = 1;  // size of the image in px
    int height = 1;
    int border = 0;                             // width in px by which the layers extend beyond each image edge
    std::uint32_t layers = 1;                   // max number of layers
    LayerFormat format = LayerFormat::rgba16f;  // format of the lens samples' images
    bool blended = false;                       // true: surfaces are blended, so rays continue behind them
    bool vertexShaderLayers = true;             // false: a geometry shader selects the layer
    std::filesystem::path shaderFolder;
    bool operator==(const LensRaysInfo&) const = default;
};

class LensRays {
public:
    // Needs a current OpenGL context.
    explicit LensRays(const LensRaysInfo& info);

    // Prepares tracing of `plan`. `frame` must hold the uniforms of `plan`, uploaded with the number of samples that
    // are drawn together as layerCount, and must exist until the last trace().
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Computes, for each pixel, bounds of the blurs of the surfaces in `layers` that the pixel's rays may hit. Must be
    // called after each DepthLayers::peel.
    void bound(const DepthLayers& layers);
    // Draws samples [first, first + count) into the bound target, each into its own layer. Colours are premultiplied;
    // pixels whose ray hits no surface are transparent. `pinhole` is the subpixel offset of the layers
    // (LensSample::pixel). The subpixel offsets of the plan's samples include this offset.
    void trace(const DepthLayers& layers, const glm::vec2& pinhole, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] const LensRaysInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const { return extents_.bytes() + reach_.bytes(); }

private:
    LensRaysInfo info_;
    GlTexture extents_;  // per square of pixels: min and max blur of the surfaces in the layers
    GlTexture reach_;    // per pixel: min and max blur of the surfaces that the pixel's rays may hit
    Program base_, extend_, bound_;
    Program trace_;
    ShaderDefines traceDefines_;
    VertexArray samples_;
    const FrameUniforms* frame_ = nullptr;
};

}  // namespace defocus::engine
