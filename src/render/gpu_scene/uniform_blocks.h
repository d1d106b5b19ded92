#pragma once
// Stores uniform blocks of one type in one buffer, aligned so that each block can be bound separately.

#include <cstring>
#include <vector>

#include "gl/buffer_writer.h"

namespace defocus::engine {

// Returns `bytes` rounded up to the driver's offset alignment for uniform blocks.
std::size_t uniformStride(std::size_t bytes);

template <typename Block>
class UniformBlocks {
public:
    UniformBlocks() = default;
    // Uploads `count` blocks; block i is blockAt(i), called in ascending order.
    UniformBlocks(std::size_t count, const auto& blockAt) : stride_(uniformStride(sizeof(Block))) {
        BufferWriter writer(count * stride_);
        std::vector<std::byte> padded(stride_);
        for (std::size_t i = 0; i < count; ++i) {
            const Block block = blockAt(i);
            std::memcpy(padded.data(), &block, sizeof(Block));
            writer.appendBytes(padded);
        }
        buffer_ = writer.finish();
    }

    void bind(GLuint binding, std::size_t index) const {
        glBindBufferRange(GL_UNIFORM_BUFFER, binding, buffer_.name(), static_cast<GLintptr>(index * stride_),
                          sizeof(Block));
    }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

private:
    std::size_t stride_ = 0;
    Buffer buffer_;
};

}  // namespace defocus::engine
