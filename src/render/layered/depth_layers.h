#pragma once
// The scene through the middle of the lens as depth layers (Everitt 2001, Interactive Order-Independent Transparency):
// in each pixel the nearest surface, the next one behind it, and so on.
//
// What no point of the lens can see takes no layer (the umbra of Lee, Eisemann and Seidel 2010, Real-Time Lens Blur
// Effects and Focus Control): what lies behind a pixel's surface and moves against it by less than a pixel over the
// whole lens.

#include <optional>

#include "gl/target.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/layer_format.h"

namespace defocus::engine {

// `plan` for an image that shows `border` px more on each side; the pixels between them keep what they show, and their
// circle of confusion in px. For pinholes: lens samples are left out, and so is the tile.
FramePlan widened(const FramePlan& plan, int border);

struct DepthLayersInfo {
    int width = 1;  // px, with the border
    int height = 1;
    std::uint32_t layers = 1;                   // at most
    LayerFormat format = LayerFormat::rgba16f;  // it holds alpha
    bool blended = false;                       // surfaces let through what lies behind them, whatever the lens
    std::filesystem::path shaderFolder;
    bool operator==(const DepthLayersInfo&) const = default;
};

class DepthLayers {
public:
    // Needs a current GL context.
    DepthLayers(GpuScene& scene, const DepthLayersInfo& info);

    // `frame` was uploaded for `pinholes` with one layer, and must outlive the drawing.
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame);
    // Peels the layers of sample `index`, up to the first that holds nothing.
    void peel(std::uint32_t index);

    // Of the sample peeled last: layers that hold anything.
    [[nodiscard]] std::uint32_t count() const { return count_; }
    // Arrays of all layers: linear radiance, premultiplied; and what shaders/layered/peel.glsl says of the surfaces.
    [[nodiscard]] const GlTexture& colors() const { return colors_; }
    [[nodiscard]] const GlTexture& surfaces() const { return surfaces_; }
    [[nodiscard]] const DepthLayersInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Draws the surfaces behind front_ into a layer; are there any?
    bool peelLayer(std::uint32_t index, std::uint32_t layer);

    DepthLayersInfo info_;
    GlTexture colors_, surfaces_, front_, depth_;
    std::vector<Target> targets_;  // one a layer
    ShadowMaps shadows_;
    SurfacePass pass_;
    GlHandle<destroyQuery> anyDrawn_;
    std::uint32_t count_ = 0;
};

}  // namespace defocus::engine
