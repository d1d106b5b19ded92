#include "gl/texture.h"

#include <algorithm>
#include <bit>

#include "core/error.h"

namespace defocus::engine {

namespace {

struct FormatRow {
    GLenum internal;
    GLenum upload;
    GLenum type;
    std::size_t bytes;
};

FormatRow row(TextureFormat format) {
    switch (format) {
        case TextureFormat::r32f:
            return {GL_R32F, GL_RED, GL_FLOAT, 4};
        case TextureFormat::rg32f:
            return {GL_RG32F, GL_RG, GL_FLOAT, 8};
        case TextureFormat::rgba32f:
            return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
        case TextureFormat::rgba16f:
            return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 8};
        case TextureFormat::rgba8:
            return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
        case TextureFormat::rgb10A2:
            return {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4};
        case TextureFormat::srgb8Alpha8:
            return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
        case TextureFormat::r32ui:
            return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
        case TextureFormat::depth32f:
            return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4};
    }
    return {};
}

}  // namespace

GlTexture::GlTexture(const TextureInfo& info) : info_(info) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (info.width > limit || info.height > limit)
        fail("{} x {} px exceeds this driver's maximum texture size of {} px", info.width, info.height, limit);
    GLint maxLayers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
    if (info.layers > maxLayers)
        fail("{} layers exceed this driver's maximum of {} layers per texture; draw fewer samples at once (--wave)",
             info.layers, maxLayers);
    GLuint name = 0;
    const GLenum oneImage = info.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glCreateTextures(info.layers > 0 ? GL_TEXTURE_2D_ARRAY : oneImage, 1, &name);
    handle_ = GlHandle<destroyTexture>(name);
    while (glGetError() != GL_NO_ERROR) {
    }
    const GLenum format = row(info.format).internal;
    if (info.layers > 0)
        glTextureStorage3D(name, info.levels, format, info.width, info.height, info.layers);
    else if (info.samples > 1)
        glTextureStorage2DMultisample(name, info.samples, format, info.width, info.height, GL_TRUE);
    else
        glTextureStorage2D(name, info.levels, format, info.width, info.height);
    if (glGetError() != GL_NO_ERROR)
        fail("out of graphics memory: cannot allocate a texture of {} x {} px and {} layers; reduce --size or --wave",
             info.width, info.height, std::max(info.layers, 1));
    const GLenum filter = info.linear ? GL_LINEAR : GL_NEAREST;
    if (info.samples == 1) sampling(filter, filter, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
}

void GlTexture::upload(int level, int width, int height, const void* pixels) {
    const FormatRow format = row(info_.format);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(name(), level, 0, 0, width, height, format.upload, format.type, pixels);
}

void GlTexture::generateMipmaps() {
    glGenerateTextureMipmap(name());
}

void GlTexture::sampling(GLenum minFilter, GLenum magFilter, GLenum wrapS, GLenum wrapT) {
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minFilter));
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magFilter));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_S, static_cast<GLint>(wrapS));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_T, static_cast<GLint>(wrapT));
}

void GlTexture::clearLayer(std::uint32_t layer) {
    const FormatRow format = row(info_.format);
    glClearTexSubImage(name(), 0, 0, 0, static_cast<GLint>(layer), info_.width, info_.height, 1, format.upload,
                       format.type, nullptr);
}

void GlTexture::copyLayer(std::uint32_t layer, const TexelRectangle& area, const GlTexture& to,
                          std::uint32_t toLayer) const {
    glCopyImageSubData(name(), GL_TEXTURE_2D_ARRAY, 0, area.x, area.y, static_cast<GLint>(layer), to.name(),
                       GL_TEXTURE_2D_ARRAY, 0, area.x, area.y, static_cast<GLint>(toLayer), area.width, area.height, 1);
}

void GlTexture::copyLayers(const GlTexture& to, std::uint32_t count) const {
    glCopyImageSubData(name(), info_.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 0, 0, 0, 0, to.name(),
                       GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, info_.width, info_.height, static_cast<GLsizei>(count));
}

std::size_t GlTexture::bytes() const {
    if (!handle_) return 0;
    std::size_t pixels = 0;
    for (int level = 0; level < info_.levels; ++level)
        pixels += static_cast<std::size_t>(std::max(info_.width >> level, 1)) *
                  static_cast<std::size_t>(std::max(info_.height >> level, 1));
    return pixels * static_cast<std::size_t>(std::max(info_.layers, info_.samples)) * pixelBytes(info_.format);
}

int mipmapLevels(int width, int height) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({width, height, 1}))));
}

std::size_t pixelBytes(TextureFormat format) {
    return row(format).bytes;
}

}  // namespace defocus::engine
