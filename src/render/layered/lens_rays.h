#pragma once
// Lens rays through depth layers: computes the range of blurs that the rays of each pixel may meet in each layer, and
// draws the images of lens samples.
//
// Lee, Eisemann and Seidel 2010 bound the depths that a pixel's rays may meet by N-buffers: min and max depth in
// squares of each power of two around each pixel. This implementation uses mipmaps instead, which take a fifth of the
// memory and give slightly wider bounds. They store blurs instead of depths, so that the bounds hold for any control of
// the blur.

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layered/depth_layers.h"

namespace defocus::engine {

struct LensRaysInfo {
    int width = 1;  // size of the image, px
    int height = 1;
    int border = 0;                             // border of the layers beyond the image on each side, px
    std::uint32_t layers = 1;                   // max number of layers
    LayerFormat format = LayerFormat::rgba16f;  // format of the lens samples' images
    bool blended = false;                       // rays continue behind surfaces
    bool vertexShaderLayers = true;             // false: a geometry shader selects the layer
    std::filesystem::path shaderFolder;
    bool operator==(const LensRaysInfo&) const = default;
};

class LensRays {
public:
    // Needs a current GL context.
    explicit LensRays(const LensRaysInfo& info);

    // `frame` must have been uploaded for `plan` with K layers, the samples per wave. It must outlive the drawing.
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Computes the bounds of the rays for the current content of the layers.
    void bound(const DepthLayers& layers);
    // Draws samples [first, first + count) into the bound target, each into its own layer. The output is premultiplied,
    // and transparent where a ray meets no surface. `pinhole`: position of the layers in the pixel (LensSample::pixel).
    // The positions of the samples include this offset.
    void trace(const DepthLayers& layers, const glm::vec2& pinhole, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] const LensRaysInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const { return extents_.bytes() + reach_.bytes(); }

private:
    LensRaysInfo info_;
    GlTexture extents_;  // min and max blur in squares of pixels
    GlTexture reach_;    // range of blurs that the rays of each pixel may meet
    Program base_, extend_, bound_;
    Program trace_;
    ShaderDefines traceDefines_;  // defines of the current trace_ program
    VertexArray samples_;
    const FrameUniforms* frame_ = nullptr;
};

}  // namespace defocus::engine
