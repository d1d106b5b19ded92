#pragma once
// Storage buffers of the lens-space kernels, and the growing buffer that holds the records of a wave.

#include <cstdint>

#include "gl/buffer.h"

namespace defocus::engine {

// Returns the max bytes of one buffer that the driver's shaders can read.
std::uint64_t largestStorage();

// Returns a buffer that shaders can read completely. Throws Error, naming the content (`what`), if it exceeds
// largestStorage().
Buffer storage(std::uint64_t bytes, const char* what);

// The ray hits of a wave, in the layout of shaders/lens_space/records.glsl.
class RecordBuffer {
public:
    // Returns the max number of records in a buffer.
    static std::uint64_t maxRecords();
    // Ensures room for `count` records; previous content may be lost.
    void reserve(std::uint64_t count);
    void bind() const;
    [[nodiscard]] std::uint64_t capacity() const;
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_;
};

}  // namespace defocus::engine
