#pragma once
// Draws the scene, as seen from the lens centre, into depth layers (Everitt 2001, Interactive Order-Independent
// Transparency): in each pixel, layer 0 is the nearest surface, layer 1 the next surface behind it, and so on.
//
// Surfaces that are hidden from all lens points are omitted (the umbra of Lee, Eisemann and Seidel 2010, Real-Time Lens
// Blur Effects and Focus Control). Such a surface is behind the pixel's nearest surface, and the parallax between the
// two over the full lens is less than a pixel.

#include <optional>

#include "gl/target.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/layer_format.h"

namespace defocus::engine {

// Returns `plan` for an image with `border` additional px at each edge. The inner pixels keep their content and their
// circle of confusion in px. The result is a plan for pinhole images: all lens points are at the lens centre, and the
// full image is drawn even if `plan` draws only a tile of the image.
FramePlan widened(const FramePlan& plan, int border);

struct DepthLayersInfo {
    int width = 1;  // size of the layers in px, including the border
    int height = 1;
    std::uint32_t layers = 1;                   // max number of layers
    LayerFormat format = LayerFormat::rgba16f;  // format of the colours, which include alpha
    // True if surfaces are blended, so that surfaces behind them are visible and must not be omitted.
    bool blended = false;
    std::filesystem::path shaderFolder;
    bool operator==(const DepthLayersInfo&) const = default;
};

class DepthLayers {
public:
    // Needs a current OpenGL context.
    DepthLayers(GpuScene& scene, const DepthLayersInfo& info);

    // Prepares the passes for `pinholes`, a plan of pinhole images made by widened(). `frame` must hold the uniforms of
    // this plan, uploaded for a single layer (layerCount 1), and must exist until the last peel().
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame);
    // Draws the layers of the plan's sample `index`, up to the first empty layer.
    void peel(std::uint32_t index);

    // Returns the number of non-empty layers after the latest peel().
    [[nodiscard]] std::uint32_t count() const { return count_; }
    // Texture arrays with all layers: premultiplied linear radiance, and surface data as in shaders/layered/peel.frag.
    [[nodiscard]] const GlTexture& colors() const { return colors_; }
    [[nodiscard]] const GlTexture& surfaces() const { return surfaces_; }
    [[nodiscard]] const DepthLayersInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Draws into a layer, for each pixel, the nearest surface behind the depth in the texture front_. Returns whether
    // any pixel was drawn.
    bool peelLayer(std::uint32_t index, std::uint32_t layer);

    DepthLayersInfo info_;
    GlTexture colors_, surfaces_, front_, depth_;
    std::vector<Target> targets_;  // one target per layer
    ShadowMaps shadows_;
    SurfacePass pass_;
    GlHandle<destroyQuery> anyDrawn_;
    std::uint32_t count_ = 0;
};

}  // namespace defocus::engine
