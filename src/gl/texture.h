#pragma once
// An immutable GL texture (2D, or an array of layers), move-only.

#include <cstddef>
#include <cstdint>

#include "gl/handle.h"

namespace defocus::engine {

enum class TextureFormat {
    r32f,
    rg32f,
    rgba32f,
    rgba16f,
    rgba8,
    rgb10A2,
    srgb8Alpha8,
    r32ui,  // integer: 32 packed bits
    depth32f,
};

struct TextureInfo {
    TextureFormat format = TextureFormat::rgba32f;
    int width = 1;
    int height = 1;
    int layers = 0;  // 0: a 2D texture; ≥ 1: a 2D array
    int levels = 1;  // mipmap levels
};

struct TexelRectangle {  // from the lower left corner
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

class GlTexture {
public:
    GlTexture() = default;
    // Throws Error when the size is beyond the driver's limits or memory.
    explicit GlTexture(const TextureInfo& info);

    // Level `level` from tightly packed pixels: bytes (rgba8, srgb8Alpha8) or floats of the format's channels.
    void upload(int level, int width, int height, const void* pixels);
    void generateMipmaps();
    void sampling(GLenum minFilter, GLenum magFilter, GLenum wrapS, GLenum wrapT);
    // Fills a layer with zeros: black and transparent, or a depth of 0.
    void clearLayer(std::uint32_t layer);
    // Copies a rectangle of layer `layer` to the same place of layer `toLayer` of a texture of the same format.
    void copyLayer(std::uint32_t layer, const TexelRectangle& area, const GlTexture& to, std::uint32_t toLayer) const;
    // Copies layers [0, count), or the one image of a texture without layers, to those of `to`, an array of the same
    // format and size.
    void copyLayers(const GlTexture& to, std::uint32_t count) const;
    void attach(GLuint unit) const { glBindTextureUnit(unit, handle_.name()); }

    [[nodiscard]] GLuint name() const { return handle_.name(); }
    [[nodiscard]] const TextureInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const;
    explicit operator bool() const { return static_cast<bool>(handle_); }

private:
    GlHandle<destroyTexture> handle_;
    TextureInfo info_;
};

// Mipmap levels of a full chain.
int mipmapLevels(int width, int height);
// Bytes a pixel.
std::size_t pixelBytes(TextureFormat format);

}  // namespace defocus::engine
