#pragma once
// Draws a bucket of alpha-blended objects as a pinhole image of its own (Garcia 2018), over nothing.
//
// What opaque surfaces hide of it is black, without coverage, at their depth. Where the bucket is empty, its surfaces
// go on without coverage at the depth of what is near: so a blur spreads its edges as disks.

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

class BucketPass {
public:
    // `opaque`: of the format `format`; must outlive this.
    BucketPass(const PinholeImage& opaque, LayerFormat format, const std::filesystem::path& shaderFolder);

    // `surfaces` was prepared; `opaque` holds the same sample.
    void draw(SurfacePass& surfaces, std::uint32_t sample, const ObjectSet& bucket);
    // Of the bucket drawn last.
    [[nodiscard]] PinholeImage& image() { return image_; }
    [[nodiscard]] std::size_t bytes() const {
        return image_.bytes() + surfaceDepth_.bytes() + surfaceOwnBlur_.bytes() + known_.bytes();
    }

private:
    const PinholeImage* opaque_;
    PinholeImage image_;
    GlTexture surfaceDepth_, surfaceOwnBlur_;  // of the bucket's nearest surfaces
    GlTexture known_;                          // the same with mipmaps
    Target colorTarget_, surfaceTarget_, knownTarget_, imageTarget_;
    Program know_, fill_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
