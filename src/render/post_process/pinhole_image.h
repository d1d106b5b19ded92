#pragma once
// A pinhole image as post-process methods blur it: what is seen through the middle of the lens, and how far away.

#include <cstddef>
#include <optional>

#include "gl/texture.h"
#include "render/layer_format.h"

namespace defocus::engine {

struct PinholeImage {
    PinholeImage() = default;
    // `format` holds alpha (rgba16f, rgba32f). `depthFormat` is depth32f, or r32f where a pass computes it.
    // `keepsOwnBlur`: what the surfaces make of the blur is kept too.
    PinholeImage(int width, int height, LayerFormat format, TextureFormat depthFormat, bool keepsOwnBlur);

    // What shaders/include/pinhole.glsl reads: depth and scales of the blur.
    void attachForBlur() const;
    // From here on, `color` reads as the coverage, in red, green and blue; or as the radiance again.
    void readAsCoverage(bool on);
    [[nodiscard]] std::size_t bytes() const { return color.bytes() + depth.bytes() + ownBlur.bytes(); }

    GlTexture color;    // linear radiance, premultiplied, with coverage as alpha
    GlTexture depth;    // reversed: near plane over distance; 0 is infinity
    GlTexture ownBlur;  // the factor, and what is added; empty: nothing of their own
    // Blurred, it is black and without coverage elsewhere, and needn't be drawn there; none: it may be seen anywhere.
    std::optional<TexelRectangle> part;
};

}  // namespace defocus::engine
