#pragma once
// The scene seen through the lens centre as depth layers (Everitt 2001, Interactive Order-Independent Transparency): in
// each pixel the nearest surface, the next surface behind it, and so on.
//
// Surfaces that no lens point can see take no layer (the umbra of Lee, Eisemann and Seidel 2010, Real-Time Lens Blur
// Effects and Focus Control). Such a surface lies behind the pixel's nearest surface and shifts against it by less than
// a pixel over the full lens.

#include <optional>

#include "gl/target.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/layer_format.h"

namespace defocus::engine {

// Returns `plan` for an image with `border` px more on each side. The inner pixels keep their content and their circle
// of confusion in px. The result is for pinholes: lens points move to the centre, and the tile is dropped.
FramePlan widened(const FramePlan& plan, int border);

struct DepthLayersInfo {
    int width = 1;  // px, including the border
    int height = 1;
    std::uint32_t layers = 1;                   // max number of layers
    LayerFormat format = LayerFormat::rgba16f;  // must hold alpha
    // Surfaces show the background through themselves, so surfaces that no lens point sees take layers too.
    bool blended = false;
    std::filesystem::path shaderFolder;
    bool operator==(const DepthLayersInfo&) const = default;
};

class DepthLayers {
public:
    // Needs a current GL context.
    DepthLayers(GpuScene& scene, const DepthLayersInfo& info);

    // `frame` must have been uploaded for `pinholes` with one layer, and must outlive the drawing.
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame);
    // Peels the layers of sample `index`; stops at the first empty layer.
    void peel(std::uint32_t index);

    // Number of layers with content, for the sample peeled last.
    [[nodiscard]] std::uint32_t count() const { return count_; }
    // Texture arrays with all layers: premultiplied linear radiance, and surface data as in shaders/layered/peel.frag.
    [[nodiscard]] const GlTexture& colors() const { return colors_; }
    [[nodiscard]] const GlTexture& surfaces() const { return surfaces_; }
    [[nodiscard]] const DepthLayersInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Draws the nearest surfaces behind front_ into a layer. Returns whether any pixel was drawn.
    bool peelLayer(std::uint32_t index, std::uint32_t layer);

    DepthLayersInfo info_;
    GlTexture colors_, surfaces_, front_, depth_;
    std::vector<Target> targets_;  // one per layer
    ShadowMaps shadows_;
    SurfacePass pass_;
    GlHandle<destroyQuery> anyDrawn_;
    std::uint32_t count_ = 0;
};

}  // namespace defocus::engine
