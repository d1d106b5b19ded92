#include "gl/texel_buffer.h"

#include "core/error.h"

namespace defocus::engine {

TexelBuffer::TexelBuffer(std::span<const float> values, GLenum format, int components, const char* what) {
    GLint max = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &max);
    const std::size_t texels = values.size() / static_cast<std::size_t>(components);
    if (texels > static_cast<std::size_t>(max))
        fail("{}: {} texels exceed this driver's limit of {} per buffer", what, texels, max);
    buffer_ = Buffer::of(values);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    texture_ = GlHandle<destroyTexture>(name);
    glTextureBuffer(name, format, buffer_.name());
}

}  // namespace defocus::engine
