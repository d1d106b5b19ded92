#pragma once
// Draws a bucket of alpha-blended objects as a separate pinhole image (Garcia 2018) on a transparent background.
//
// Pixels hidden by opaque surfaces are black with zero coverage, at the opaque depth. In pixels without bucket
// surfaces, coverage is zero and the depth is extrapolated from nearby bucket surfaces. A blur then spreads the
// bucket's edges as disks.

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

class BucketPass {
public:
    // `opaque` must have the format `format` and outlive this pass.
    BucketPass(const PinholeImage& opaque, LayerFormat format, const std::filesystem::path& shaderFolder);

    // `surfaces` must be prepared, and `opaque` must hold the same sample.
    void draw(SurfacePass& surfaces, std::uint32_t sample, const ObjectSet& bucket);
    // Image of the bucket drawn last.
    [[nodiscard]] PinholeImage& image() { return image_; }
    [[nodiscard]] std::size_t bytes() const {
        return image_.bytes() + surfaceDepth_.bytes() + surfaceOwnBlur_.bytes() + known_.bytes();
    }

private:
    const PinholeImage* opaque_;
    PinholeImage image_;
    GlTexture surfaceDepth_, surfaceOwnBlur_;  // of the bucket's nearest surfaces
    GlTexture known_;                          // depth and own blur of these surfaces, with mipmaps
    Target colorTarget_, surfaceTarget_, knownTarget_, imageTarget_;
    Program know_, fill_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
