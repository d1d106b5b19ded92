#pragma once
// Arbitrary output variables (AOVs): data about the nearest surface at each pixel's centre, seen through a pinhole.

#include <filesystem>
#include <optional>

#include "gl/target.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

struct AovImages {
    Image depth;  // m along the view axis; infinity where no surface is
    // Signed circle of confusion in px, > 0 behind the focus plane. Empty pixels have the value at infinity.
    Image coc;
    Image level;  // fractional level λ of the object; −1 where no surface is
};

// Draws the AOVs as textures (r32f, row 0 at the bottom) for successive frames of one world. Needs a current GL
// context.
class AovPass {
public:
    explicit AovPass(const World& world, std::filesystem::path shaderFolder = {});

    // Draws opaque, alpha-tested and blended surfaces alike, each at its nearest integer level.
    void draw(const FramePlan& plan);
    // Draws the visible edges of the triangles that draw() drew, coloured by λ (viridis), premultiplied by alpha.
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

// Draws the AOVs of one frame and reads them back.
AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// Level λ at which colour maps saturate.
inline constexpr float coarsestShownLevel = 8;

// Returns λ as colours (viridis): level 0 is dark violet, level 8 and above is yellow. Pixels without a surface are
// black.
Image levelColourMap(const Image& level);

}  // namespace defocus::engine
