#pragma once
// An immutable-size GL buffer and a vertex array, both move-only.

#include <cstddef>
#include <span>

#include "gl/handle.h"

namespace defocus::engine {

class Buffer {
public:
    Buffer() = default;
    // `bytes` of storage holding `data` (null: undefined contents). Zero bytes give a valid buffer of one unused byte.
    explicit Buffer(std::size_t bytes, const void* data = nullptr);

    template <typename T>
    static Buffer of(std::span<const T> items) {
        return Buffer(items.size_bytes(), items.data());
    }

    void update(std::size_t offset, std::size_t bytes, const void* data);
    // Copies `bytes` from `offset` on into `data`, once all that writes them is done. Writes of shaders need a barrier
    // of GL_BUFFER_UPDATE_BARRIER_BIT before.
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
    // Attribute `location` reads `components` values of GL type `type` from binding point `location`; integers are
    // normalised to [0, 1] or [−1, 1] where asked. With `perInstance` it advances once an instance.
    void attribute(GLuint location, GLint components, GLenum type, bool normalized, bool perInstance = false);
    // Attaches a buffer to the binding point of `location`, from byte `offset`, `stride` bytes a vertex.
    void bind(GLuint location, const Buffer& buffer, std::size_t offset, std::size_t stride);
    void indices(const Buffer& buffer);
    // Draws read it from now on. Goes before Program::use: the other way round, NVIDIA's driver 580 now and then left
    // out the first draw of a program.
    void use() const { glBindVertexArray(name()); }

private:
    [[nodiscard]] GLuint name() const { return handle_.name(); }

    GlHandle<destroyVertexArray> handle_;
};

}  // namespace defocus::engine
