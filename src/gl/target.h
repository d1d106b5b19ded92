#pragma once
// A framebuffer over textures that it doesn't own: colour attachments in order and an optional depth texture. Array
// textures are attached with all their layers (gl_Layer picks one).

#include <cstdint>
#include <optional>
#include <vector>

#include "gl/texture.h"

namespace defocus::engine {

class Target {
public:
    Target() = default;
    // At most 8 colours; none for depth alone. Throws Error in words when the driver can't render to this combination.
    explicit Target(const std::vector<const GlTexture*>& colors, const GlTexture* depth = nullptr);
    // Each layer of an array texture, at most 8, is a colour.
    static Target ofLayers(const GlTexture& array);
    // An image, then the first `layers` of an array texture of its size, at most 8 together.
    static Target ofImageAndLayers(const GlTexture& image, const GlTexture& array, int layers);
    // Layer `layer` and mipmap level `level` alone of array textures of one size.
    static Target ofLayer(const std::vector<const GlTexture*>& colors, std::uint32_t layer, int level = 0);
    // Layer `layer` alone of array textures; `depth` has no layers.
    Target(const std::vector<const GlTexture*>& colors, const GlTexture& depth, std::uint32_t layer);

    // Makes it current with its whole area as viewport.
    void bind() const;
    [[nodiscard]] GLuint name() const { return handle_.name(); }

private:
    Target(const std::vector<const GlTexture*>& colors, const GlTexture* depth, std::optional<std::uint32_t> layer);
    void create();
    void addColor(const GlTexture& color, std::optional<std::uint32_t> layer, int level = 0);
    void finish(const GlTexture* depth);

    GlHandle<destroyFramebuffer> handle_;
    GLsizei colors_ = 0;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace defocus::engine
