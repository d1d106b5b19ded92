#pragma once
// Draws a bucket (transparency_buckets.h) of alpha-blended objects as a separate pinhole image on a transparent
// background (Garcia 2018).
//
// Pixels hidden by opaque surfaces are black with zero coverage, at the depth of the opaque surface. Pixels without a
// surface of the bucket have zero coverage and a depth extrapolated from nearby surfaces of the bucket, so that the
// bucket's edges are blurred like its surfaces.

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

class BucketPass {
public:
    // `opaque` is the image of the opaque surfaces. The image must have the format `format` and outlive this object.
    BucketPass(const PinholeImage& opaque, LayerFormat format, const std::filesystem::path& shaderFolder);

    // Draws the objects of `bucket` for sample `sample`. `surfaces` must be prepared, and the image of the opaque
    // surfaces must have been drawn for the same sample.
    void draw(SurfacePass& surfaces, std::uint32_t sample, const ObjectSet& bucket);
    // Returns the image of the latest draw().
    [[nodiscard]] PinholeImage& image() { return image_; }
    [[nodiscard]] std::size_t bytes() const {
        return image_.bytes() + surfaceDepth_.bytes() + surfaceOwnBlur_.bytes() + known_.bytes();
    }

private:
    const PinholeImage* opaque_;
    PinholeImage image_;
    GlTexture surfaceDepth_, surfaceOwnBlur_;  // depth and blur modifiers of the bucket's nearest surfaces
    // Depth and blur modifiers of surfaceDepth_ and surfaceOwnBlur_, with mip levels. The mip levels provide values for
    // pixels without a surface.
    GlTexture known_;
    Target colorTarget_, surfaceTarget_, knownTarget_, imageTarget_;
    Program know_, fill_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
