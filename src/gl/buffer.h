#pragma once
// Move-only owners of OpenGL objects: a buffer of fixed size, and a vertex array.

#include <cstddef>
#include <span>

#include "gl/handle.h"

namespace defocus::engine {

class Buffer {
public:
    Buffer() = default;
    // Creates `bytes` of storage filled from `data` (null: undefined contents). Zero bytes create a valid buffer with
    // one unused byte.
    explicit Buffer(std::size_t bytes, const void* data = nullptr);

    template <typename T>
    static Buffer of(std::span<const T> items) {
        return Buffer(items.size_bytes(), items.data());
    }

    void update(std::size_t offset, std::size_t bytes, const void* data);
    // Copies `bytes` from `offset` into `data`; waits for the GPU. Shader writes need a prior barrier with
    // GL_BUFFER_UPDATE_BARRIER_BIT.
    void read(std::size_t offset, std::size_t bytes, void* data) const;

    [[nodiscard]] GLuint name() const { return handle_.name(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    explicit operator bool() const { return static_cast<bool>(handle_); }

private:
    GlHandle<destroyBuffer> handle_;
    std::size_t bytes_ = 0;
};

class VertexArray {
public:
    VertexArray();
    // Enables attribute `location`, which reads `components` values of GL type `type` from binding point `location`.
    // `normalized` maps integers to [0, 1] or [−1, 1]. With `perInstance`, the attribute advances once per instance.
    void attribute(GLuint location, GLint components, GLenum type, bool normalized, bool perInstance = false);
    // Attaches `buffer` to binding point `location`. `offset`: position of the first byte of the data; `stride`: bytes
    // from one vertex or instance to the next.
    void bind(GLuint location, const Buffer& buffer, std::size_t offset, std::size_t stride);
    void indices(const Buffer& buffer);
    // Binds the vertex array for later draws. Call it before Program::use: in the reverse order, NVIDIA driver 580
    // sometimes skips a program's first draw.
    void use() const { glBindVertexArray(name()); }

private:
    [[nodiscard]] GLuint name() const { return handle_.name(); }

    GlHandle<destroyVertexArray> handle_;
};

}  // namespace defocus::engine
