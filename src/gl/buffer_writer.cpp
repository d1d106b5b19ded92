#include "gl/buffer_writer.h"

#include <utility>

namespace defocus::engine {

namespace {

constexpr std::size_t maxPending = std::size_t{1} << 18;

}  // namespace

void BufferWriter::appendBytes(std::span<const std::byte> bytes) {
    if (pending_.size() + bytes.size() > maxPending) flush();
    if (bytes.size() > maxPending) {
        buffer_.update(written_, bytes.size(), bytes.data());
        written_ += bytes.size();
    } else {
        pending_.insert(pending_.end(), bytes.begin(), bytes.end());
    }
}

Buffer BufferWriter::finish() {
    flush();
    return std::move(buffer_);
}

void BufferWriter::flush() {
    buffer_.update(written_, pending_.size(), pending_.data());
    written_ += pending_.size();
    pending_.clear();
}

}  // namespace defocus::engine
