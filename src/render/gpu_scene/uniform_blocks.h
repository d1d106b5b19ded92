#pragma once
// Uniform blocks of one type in one buffer, aligned so that each can be bound separately.

#include <cstring>
#include <vector>

#include "gl/buffer.h"

namespace defocus::engine {

// Returns `bytes` rounded up to the driver's offset alignment for uniform blocks.
std::size_t uniformStride(std::size_t bytes);

template <typename Block>
class UniformBlocks {
public:
    UniformBlocks() = default;
    explicit UniformBlocks(const std::vector<Block>& blocks) : stride_(uniformStride(sizeof(Block))) {
        std::vector<std::byte> bytes(blocks.size() * stride_);
        for (std::size_t i = 0; i < blocks.size(); ++i)
            std::memcpy(bytes.data() + i * stride_, &blocks[i], sizeof(Block));
        buffer_ = Buffer(bytes.size(), bytes.data());
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
