#pragma once
// A buffer that shaders read as texels (samplerBuffer), move-only.

#include <span>

#include "gl/buffer.h"

namespace defocus::engine {

class TexelBuffer {
public:
    TexelBuffer() = default;
    // Texels of `format` (GL_RGBA32F, GL_RGB32F), `components` floats each. `what` names them in the Error that is
    // thrown when they are more than the driver reads in one buffer.
    TexelBuffer(std::span<const float> values, GLenum format, int components, const char* what);

    void attach(GLuint unit) const { glBindTextureUnit(unit, texture_.name()); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }
    explicit operator bool() const { return static_cast<bool>(texture_); }

private:
    Buffer buffer_;
    GlHandle<destroyTexture> texture_;
};

}  // namespace defocus::engine
