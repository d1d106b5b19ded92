#pragma once
// Framebuffer with attached textures, which it does not own: colour textures in order, and an optional depth texture.
// Array textures are attached with all layers; gl_Layer selects one.

#include <cstdint>
#include <optional>
#include <vector>

#include "gl/texture.h"

namespace defocus::engine {

class Target {
public:
    Target() = default;
    // Attaches 0 to 8 colour textures and optionally `depth`. Throws Error if the driver cannot render to this
    // combination.
    explicit Target(const std::vector<const GlTexture*>& colors, const GlTexture* depth = nullptr);
    // Attaches a 2D texture and the first `layers` layers of an array texture of equal size, at most 8 colour
    // attachments in total.
    static Target ofImageAndLayers(const GlTexture& image, const GlTexture& array, int layers);
    // Attaches only layer `layer` and mip level `level` of each array texture; their sizes must be equal. `depth` is a
    // 2D texture.
    static Target ofLayer(const std::vector<const GlTexture*>& colors, std::uint32_t layer, int level = 0,
                          const GlTexture* depth = nullptr);

    // Copies all colour attachments and, if `depth` is true, the depth attachment to `to`, which has the same size and
    // formats. If this target is multisampled, a pixel gets the mean colour of its samples and the depth of one sample.
    void resolve(const Target& to, bool depth) const;
    // Binds the framebuffer and sets the viewport to its full size.
    void bind() const;
    [[nodiscard]] GLuint name() const { return handle_.name(); }

private:
    void create();
    void addColor(const GlTexture& color, std::optional<std::uint32_t> layer, int level = 0);
    void finish(const GlTexture* depth);
    void drawAllColors() const;  // selects all colour attachments as draw buffers

    GlHandle<destroyFramebuffer> handle_;
    GLsizei colors_ = 0;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace defocus::engine
