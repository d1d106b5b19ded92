#pragma once
// What post-process methods start from: the scene through the middle of the lens, its sky included, with the depth of
// each pixel.

#include <optional>

#include "gl/target.h"
#include "render/layer_format.h"
#include "render/shadow_maps.h"
#include "render/surface_pass.h"

namespace defocus {

// The objects of `plan`, each at the whole level nearest to its λ, for `count` samples in the middle of the lens. They
// are spread over the pixel by Hammersley's points; one alone lies in its middle. The plan's lens (its CoC) is kept.
// What moves is drawn as it is in the middle of the exposure. A pinhole has 16 points on each light.
FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count);

class PinholePass {
public:
    // `format` holds alpha (rgba16f, rgba32f). `ownBlur`: what the surfaces make of the blur is kept too. Needs a
    // current GL context.
    PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur,
                const std::filesystem::path& shaderFolder);

    // `frame` was uploaded for `pinholes` with one layer, and must outlive the drawing.
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame);
    // Draws sample `index`. Alpha-blended surfaces leave their depth too, in a pass of its own: what lies behind them
    // is blurred as they are (Scheuermann 2004).
    void draw(std::uint32_t index);

    // Of the sample drawn last: linear radiance with coverage as alpha (premultiplied; 1 but over a transparent
    // background), and reversed depth (near plane over distance; 0 is infinity).
    [[nodiscard]] const GlTexture& color() const { return color_; }
    // From here on, color() reads as the coverage, in red, green and blue; or as the radiance again.
    void readAsCoverage(bool on);
    [[nodiscard]] const GlTexture& depth() const { return depth_; }
    // What shaders/include/pinhole.glsl reads: depth and scales of the blur.
    void attachForBlur() const;
    [[nodiscard]] bool hasOwnBlur() const { return static_cast<bool>(ownBlur_); }
    [[nodiscard]] int width() const { return color_.info().width; }
    [[nodiscard]] int height() const { return color_.info().height; }
    [[nodiscard]] std::size_t bytes() const {
        return color_.bytes() + depth_.bytes() + ownBlur_.bytes() + shadows_.bytes() + surfaces_.bytes();
    }

private:
    GlTexture color_;
    GlTexture depth_;
    GlTexture ownBlur_;  // the factor, and what is added; empty: nothing of their own
    Target target_;
    bool transparent_ = false;  // the background
    ShadowMaps shadows_;
    SurfacePass surfaces_;
};

}  // namespace defocus
