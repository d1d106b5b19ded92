#pragma once
// Creates storage buffers for the lens-space methods, and holds the records (ray hits) of a batch of rays in a buffer
// that grows.

#include <cstdint>

#include "gl/buffer.h"

namespace defocus::engine {

// Returns the max size of a storage buffer in bytes (GL_MAX_SHADER_STORAGE_BLOCK_SIZE).
std::uint64_t largestStorage();

// Returns a storage buffer of `bytes` bytes. Throws Error, with `what` as the name of the content, if `bytes` exceeds
// largestStorage().
Buffer storage(std::uint64_t bytes, const char* what);

// Ray hits of a batch (wave) of rays, in the layout of shaders/lens_space/records.glsl.
class RecordBuffer {
public:
    // Returns the max number of records (ray hits) that fit into a storage buffer.
    static std::uint64_t maxRecords();
    // Ensures that the buffer has room for `count` records (ray hits). The buffer's content may be lost.
    void reserve(std::uint64_t count);
    void bind() const;
    [[nodiscard]] std::uint64_t capacity() const;
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_;
};

}  // namespace defocus::engine
