#include "gl/buffer.h"

#include <algorithm>

#include "core/error.h"

namespace defocus::engine {

Buffer::Buffer(std::size_t bytes, const void* data) : bytes_(bytes) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    handle_ = GlHandle<destroyBuffer>(name);
    while (glGetError() != GL_NO_ERROR) {
    }
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 1)), bytes > 0 ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    if (glGetError() != GL_NO_ERROR)
        fail(
            "out of graphics memory: cannot allocate a buffer of {} bytes; reduce --memory or --size, or use a smaller "
            "scene",
            bytes);
}

void Buffer::update(std::size_t offset, std::size_t bytes, const void* data) {
    if (bytes > 0) glNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

// Reads through a staging buffer in main memory. If a buffer is read directly, some drivers move it to main memory,
// where shader writes are slow.
void Buffer::read(std::size_t offset, std::size_t bytes, void* data) const {
    if (bytes == 0) return;
    GLuint name = 0;
    glCreateBuffers(1, &name);
    const GlHandle<destroyBuffer> copy(name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), nullptr, GL_CLIENT_STORAGE_BIT | GL_MAP_READ_BIT);
    glCopyNamedBufferSubData(handle_.name(), name, static_cast<GLintptr>(offset), 0, static_cast<GLsizeiptr>(bytes));
    glGetNamedBufferSubData(name, 0, static_cast<GLsizeiptr>(bytes), data);
}

VertexArray::VertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    handle_ = GlHandle<destroyVertexArray>(name);
}

void VertexArray::attribute(GLuint location, GLint components, GLenum type, bool normalized, bool perInstance) {
    glEnableVertexArrayAttrib(name(), location);
    glVertexArrayAttribFormat(name(), location, components, type, normalized ? GL_TRUE : GL_FALSE, 0);
    glVertexArrayAttribBinding(name(), location, location);
    glVertexArrayBindingDivisor(name(), location, perInstance ? 1 : 0);
}

void VertexArray::bind(GLuint location, const Buffer& buffer, std::size_t offset, std::size_t stride) {
    glVertexArrayVertexBuffer(name(), location, buffer.name(), static_cast<GLintptr>(offset),
                              static_cast<GLsizei>(stride));
}

void VertexArray::indices(const Buffer& buffer) {
    glVertexArrayElementBuffer(name(), buffer.name());
}

}  // namespace defocus::engine
