#pragma once
// Pinhole image for the post-process methods: colour and depth of the scene as seen from the lens centre.

#include <cstddef>
#include <optional>

#include "gl/texture.h"
#include "render/layer_format.h"

namespace defocus::engine {

struct PinholeImage {
    PinholeImage() = default;
    // `format` must have alpha (rgba16f, rgba32f). `depthFormat` is depth32f, or r32f if a fragment shader writes the
    // depth. If `keepsOwnBlur`, the blur modifiers of surfaces are also stored. `samples`: samples per pixel; above 1,
    // the image is multisampled.
    PinholeImage(int width, int height, LayerFormat format, TextureFormat depthFormat, bool keepsOwnBlur,
                 int samples = 1);

    // Binds depth and blur modifiers for shaders/include/pinhole.glsl.
    void attachForBlur() const;
    // Sets the texture swizzle of `color`: if `on`, shaders read the coverage in red, green and blue; otherwise the
    // radiance.
    void readAsCoverage(bool on);
    [[nodiscard]] std::size_t bytes() const { return color.bytes() + depth.bytes() + ownBlur.bytes(); }

    GlTexture color;    // premultiplied linear radiance, with coverage as alpha
    GlTexture depth;    // reversed: near plane / distance; 0 is infinity
    GlTexture ownBlur;  // blur modifiers of surfaces (factor and offset); empty if no surface has any
    // Rectangle outside which the blurred image is black with zero coverage and need not be drawn. nullopt: full image.
    std::optional<TexelRectangle> part;
    const PinholeImage* multisampled = nullptr;  // this image before its samples were averaged; null: not multisampled
};

}  // namespace defocus::engine
