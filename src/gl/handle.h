#pragma once
// Move-only owner of an OpenGL object, which it stores as an OpenGL name (GLuint).

#include <epoxy/gl.h>

#include <utility>

namespace defocus::engine {

template <void (*destroy)(GLuint)>
class GlHandle {
public:
    GlHandle() = default;
    explicit GlHandle(GLuint name) : name_(name) {}
    GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    GlHandle(const GlHandle&) = delete;
    GlHandle& operator=(const GlHandle&) = delete;
    ~GlHandle() {
        if (name_ != 0) destroy(name_);
    }

    [[nodiscard]] GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

inline void destroyBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
inline void destroyTexture(GLuint name) {
    glDeleteTextures(1, &name);
}
inline void destroyFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
inline void destroyVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
inline void destroyProgram(GLuint name) {
    glDeleteProgram(name);
}
inline void destroyQuery(GLuint name) {
    glDeleteQueries(1, &name);
}

}  // namespace defocus::engine
