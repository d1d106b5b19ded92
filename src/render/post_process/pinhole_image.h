#pragma once
// A pinhole image for the post-process methods: colour and depth of the scene seen through the lens centre.

#include <cstddef>
#include <optional>

#include "gl/texture.h"
#include "render/layer_format.h"

namespace defocus::engine {

struct PinholeImage {
    PinholeImage() = default;
    // `format` must hold alpha (rgba16f, rgba32f). `depthFormat` is depth32f, or r32f if a pass computes the depth.
    // `keepsOwnBlur`: also stores the blur controls of surfaces.
    PinholeImage(int width, int height, LayerFormat format, TextureFormat depthFormat, bool keepsOwnBlur);

    // Binds the inputs of shaders/include/pinhole.glsl: depth and blur controls.
    void attachForBlur() const;
    // Switches what `color` reads as: with `on` the coverage in red, green and blue, else the radiance.
    void readAsCoverage(bool on);
    [[nodiscard]] std::size_t bytes() const { return color.bytes() + depth.bytes() + ownBlur.bytes(); }

    GlTexture color;    // premultiplied linear radiance, with coverage as alpha
    GlTexture depth;    // reversed: near plane over distance; 0 is infinity
    GlTexture ownBlur;  // Blur controls of surfaces: factor and offset; empty if no surface has its own.
    // Outside this rectangle the blurred image is black with zero coverage and needs no drawing. Empty: the full image.
    std::optional<TexelRectangle> part;
};

}  // namespace defocus::engine
