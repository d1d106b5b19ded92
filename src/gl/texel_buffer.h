#pragma once
// Move-only owner of a buffer that shaders read as texels (samplerBuffer).

#include <span>

#include "gl/buffer.h"

namespace defocus::engine {

class TexelBuffer {
public:
    TexelBuffer() = default;
    // Uploads texels of `format` (GL_RGBA32F, GL_RGB32F) with `components` floats each. Throws Error, with `what` as
    // the name of the data, if the number of texels exceeds the driver's limit.
    TexelBuffer(std::span<const float> values, GLenum format, int components, const char* what);

    void attach(GLuint unit) const { glBindTextureUnit(unit, texture_.name()); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }
    explicit operator bool() const { return static_cast<bool>(texture_); }

private:
    Buffer buffer_;
    GlHandle<destroyTexture> texture_;
};

}  // namespace defocus::engine
