#pragma once
// Lens rays through depth layers: which blurs the rays of each pixel may meet in each layer, and the images of lens
// samples.
//
// Lee, Eisemann and Seidel 2010 bound the depths that a pixel's rays may meet by N-buffers: the least and greatest
// depth in squares of each power of two around each pixel. Here mipmaps hold them, which take a fifth of that memory
// and give slightly wider bounds, and they hold blurs instead of depths, so that any control of the blur is bounded
// too.

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layered/depth_layers.h"

namespace defocus::engine {

struct LensRaysInfo {
    int width = 1;  // px, of the image
    int height = 1;
    int border = 0;                             // px that the layers show beyond it, on each side
    std::uint32_t layers = 1;                   // at most
    LayerFormat format = LayerFormat::rgba16f;  // of the lens samples' images
    bool blended = false;                       // rays go on behind surfaces
    bool vertexShaderLayers = true;             // false: a geometry shader picks the layer
    std::filesystem::path shaderFolder;
    bool operator==(const LensRaysInfo&) const = default;
};

class LensRays {
public:
    // Needs a current GL context.
    explicit LensRays(const LensRaysInfo& info);

    // `frame` was uploaded for `plan` with as many layers as a wave draws, and must outlive the drawing.
    void prepare(const FramePlan& plan, const FrameUniforms& frame);
    // Finds what rays may meet in the layers as they are now.
    void bound(const DepthLayers& layers);
    // Draws samples [first, first + count) into the target that is bound, each into its layer: premultiplied, and
    // transparent where a ray meets nothing. `pinhole`: the layers' place in the pixel (LensSample::pixel), which the
    // samples' places contain; what is in focus doesn't depend on the rest of them.
    void trace(const DepthLayers& layers, const glm::vec2& pinhole, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] const LensRaysInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const { return extents_.bytes() + reach_.bytes(); }

private:
    LensRaysInfo info_;
    GlTexture extents_;  // least and greatest blur in squares
    GlTexture reach_;    // of the rays of each pixel
    Program base_, extend_, bound_;
    Program trace_;
    ShaderDefines traceDefines_;  // that trace_ was built with
    VertexArray samples_;
    const FrameUniforms* frame_ = nullptr;
};

}  // namespace defocus::engine
