#pragma once
// Arbitrary output variables: what a pixel's nearest surface is, through the pinhole at the pixel's centre.

#include <filesystem>
#include <optional>

#include "gl/target.h"
#include "gl/texel_buffer.h"
#include "image/image.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

struct AovImages {
    Image depth;  // m along the view axis; infinity where nothing is
    Image coc;    // signed circle of confusion, px, > 0 behind the focus plane; the value at infinity where nothing is
    Image level;  // the object's fractional level λ; −1 where nothing is
    Image rate;   // the images of the object that "multirate" draws for a lens sample, 1/4 … 1; −1 where nothing is
};

// The same as textures (r32f, row 0 at the bottom), for frame after frame of one world. Needs a current GL context.
class AovPass {
public:
    explicit AovPass(const World& world, std::filesystem::path shaderFolder = {});

    // Draws opaque, alpha-tested and blended surfaces alike, at the nearest whole level. Rates are those of
    // "multirate", with cells=off where it `shares` images.
    void draw(const FramePlan& plan, bool shares = false);
    // The edges of the triangles that draw() drew and that nothing hides, coloured by λ (viridis), premultiplied.
    void drawWireframe();

    [[nodiscard]] const GlTexture& depth() const { return depth_; }
    [[nodiscard]] const GlTexture& coc() const { return coc_; }
    [[nodiscard]] const GlTexture& level() const { return level_; }
    [[nodiscard]] const GlTexture& rate() const { return rate_; }
    [[nodiscard]] const GlTexture& wireframe() const { return wireframe_; }

private:
    void makeTargets(int width, int height);

    std::filesystem::path shaderFolder_;
    GpuScene scene_;
    SurfacePass surfaces_;
    SurfacePass edges_;
    FrameUniforms frame_;
    FramePlan pinhole_;
    TexelBuffer rates_;  // of the world's objects
    GlTexture depth_, coc_, level_, rate_, depthBuffer_, wireframe_, levelColours_;
    Target target_, wireTarget_;
};

// Draws them once.
AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {},
                     bool shares = false);

// λ from which on levels look alike in colour maps.
inline constexpr float coarsestShownLevel = 8;

// Images a lens sample from which on rates look alike in colour maps.
inline constexpr float minShownRate = 1.0f / 4;

// Rates as colours that a person can read: an image for each lens sample dark violet, one for two in the middle, and
// one for four or more yellow (viridis), black where nothing is.
Image rateColourMap(const Image& rate);

// λ as colours that a person can read: level 0 dark violet to level 8 and beyond yellow (viridis), black where nothing
// is.
Image levelColourMap(const Image& level);

}  // namespace defocus::engine
