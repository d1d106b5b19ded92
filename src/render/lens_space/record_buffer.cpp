#include "render/lens_space/record_buffer.h"

#include "core/error.h"
#include "render/lens_space/visibility_kernel.h"

namespace defocus::engine {

std::uint64_t largestStorage() {
    GLint64 max = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &max);
    return static_cast<std::uint64_t>(max);
}

Buffer storage(std::uint64_t bytes, const char* what) {
    if (bytes > largestStorage())
        fail("{} need {} bytes, but this driver's limit is {} bytes per buffer; choose method accumulation", what,
             bytes, largestStorage());
    return Buffer(bytes);
}

std::uint64_t RecordBuffer::maxRecords() {
    return largestStorage() / recordBytes;
}

void RecordBuffer::reserve(std::uint64_t count) {
    if (capacity() >= count) return;
    buffer_ = Buffer();  // free the old buffer first: memory might not suffice for old and new buffers
    buffer_ = Buffer(count * recordBytes);
}

void RecordBuffer::bind() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, buffer_.name());
}

std::uint64_t RecordBuffer::capacity() const {
    return buffer_.bytes() / recordBytes;
}

}  // namespace defocus::engine
