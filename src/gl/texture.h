#pragma once
// Move-only owner of an OpenGL texture with immutable storage: 2D, 2D array, or multisampled 2D.

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
    r32ui,  // unsigned integer
    depth32f,
};

struct TextureInfo {
    TextureFormat format = TextureFormat::rgba32f;
    int width = 1;
    int height = 1;
    int layers = 0;       // number of layers of a 2D array; 0: 2D texture
    int levels = 1;       // number of mip levels
    int samples = 1;      // samples per pixel; above 1: multisampled 2D texture without layers, mip levels or filtering
    bool linear = false;  // true: linear filtering; false: nearest texel; see also GlTexture::sampling
};

struct TexelRectangle {  // in texels; origin at the lower left corner
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

class GlTexture {
public:
    GlTexture() = default;
    // Allocates the texture. Throws Error if the size exceeds the driver's limits or memory.
    explicit GlTexture(const TextureInfo& info);

    // Fills mip level `level` from tightly packed pixels: 4 bytes each (rgba8, srgb8Alpha8), or one float per channel
    // of the format.
    void upload(int level, int width, int height, const void* pixels);
    void generateMipmaps();
    // Sets filtering and wrapping. By default, the filtering is that of TextureInfo, and the wrapping is
    // GL_CLAMP_TO_EDGE.
    void sampling(GLenum minFilter, GLenum magFilter, GLenum wrapS, GLenum wrapT);
    // Clears layer `layer` to zeros: transparent black, or depth 0.
    void clearLayer(std::uint32_t layer);
    // Copies a rectangle of layer `layer` to the same position in layer `toLayer` of `to`, which has the same format.
    void copyLayer(std::uint32_t layer, const TexelRectangle& area, const GlTexture& to, std::uint32_t toLayer) const;
    // Copies layers [0, count), or the only image of a 2D texture, to the same layers of array texture `to`. Formats
    // and sizes must match.
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

// Returns the number of mip levels down to 1 × 1 px.
int mipmapLevels(int width, int height);
std::size_t pixelBytes(TextureFormat format);

}  // namespace defocus::engine
