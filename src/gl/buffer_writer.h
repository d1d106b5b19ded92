#pragma once
// Fills a new GPU buffer from front to back. Appended pieces are joined in main memory and transferred together,
// because each transfer to the GPU takes time.

#include <cstddef>
#include <span>
#include <vector>

#include "gl/buffer.h"

namespace defocus::engine {

class BufferWriter {
public:
    // Creates a buffer of `bytes` bytes, all of which must be appended.
    explicit BufferWriter(std::size_t bytes) : buffer_(bytes) {}

    template <typename T>
    void append(std::span<const T> items) {
        appendBytes(std::as_bytes(items));
    }
    void appendBytes(std::span<const std::byte> bytes);
    // Returns the filled buffer. The writer must not be used afterwards.
    Buffer finish();

private:
    void flush();

    Buffer buffer_;
    std::size_t written_ = 0;         // bytes already in buffer_
    std::vector<std::byte> pending_;  // appended bytes that are not in buffer_ yet
};

}  // namespace defocus::engine
