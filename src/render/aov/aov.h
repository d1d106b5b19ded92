#pragma once
// Draws arbitrary output variables (AOVs): per-pixel data of the nearest surface at the pixel's centre in a pinhole
// view.

#include <filesystem>
#include <optional>

#include "gl/target.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

struct AovImages {
    Image depth;  // depth in m along the view axis; +∞ for pixels without a surface
    // Signed diameter of the circle of confusion in px, > 0 behind the focus plane. Pixels without a surface have the
    // value at infinite depth.
    Image coc;
    Image level;  // fractional level of detail λ of the object; −1 for pixels without a surface
};

// Draws AOVs into textures (r32f, row 0 at the bottom) for successive frames of one world. Needs a current OpenGL
// context.
class AovPass {
public:
    explicit AovPass(const World& world, std::filesystem::path shaderFolder = {});

    // Draws the AOVs of one frame. Blended surfaces count as opaque, and each object is drawn at the integer level of
    // detail nearest to its fractional level λ.
    void draw(const FramePlan& plan);
    // Draws the visible edges of the triangles of the latest draw(), coloured by level of detail (viridis colour map),
    // in premultiplied RGBA.
    void drawWireframe();

    [[nodiscard]] const GlTexture& depth() const { return depth_; }
    [[nodiscard]] const GlTexture& coc() const { return coc_; }
    [[nodiscard]] const GlTexture& level() const { return level_; }
    [[nodiscard]] const GlTexture& wireframe() const { return wireframe_; }

private:
    void makeTargets(int width, int height);

    std::filesystem::path shaderFolder_;
    GpuScene scene_;
    SurfacePass surfaces_;
    SurfacePass edges_;
    FrameUniforms frame_;
    FramePlan pinhole_;
    GlTexture depth_, coc_, level_, depthBuffer_, wireframe_, levelColours_;
    Target target_, wireTarget_;
};

// Returns the AOVs of one frame.
AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Level of detail λ at which colour maps of levels saturate.
inline constexpr float coarsestShownLevel = 8;

// Maps levels of detail to linear RGB with the viridis colour map: level 0 is dark violet, level 8 and above is yellow.
// Pixels without a surface (level −1) are black.
Image levelColourMap(const Image& level);

}  // namespace defocus::engine
