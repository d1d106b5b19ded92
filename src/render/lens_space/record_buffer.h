#pragma once
// Buffers that the lens-space kernels read and write, and the records among them, of which a wave asks for more or
// fewer.

#include <cstdint>

#include "gl/buffer.h"

namespace defocus::engine {

// The most bytes that this driver's shaders read of one buffer.
std::uint64_t largestStorage();

// A buffer that shaders read whole. Throws Error, naming what it holds, if that is more than they can.
Buffer storage(std::uint64_t bytes, const char* what);

// What the rays of a wave meet, as shaders/lens_space/records.glsl has it.
class RecordBuffer {
public:
    // The most that fit into a buffer.
    static std::uint64_t maxRecords();
    // Makes room for `count` records; what the buffer held may be lost.
    void reserve(std::uint64_t count);
    void bind() const;
    [[nodiscard]] std::uint64_t capacity() const;
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_;
};

}  // namespace defocus::engine
