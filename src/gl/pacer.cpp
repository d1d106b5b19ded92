#include "gl/pacer.h"

#include <string_view>

namespace defocus::engine {

namespace {

constexpr std::uint64_t softwareBatch = 500'000;  // triangles; each takes about 250 bytes in llvmpipe's bins
constexpr std::size_t openBatches = 2;
constexpr GLuint64 longestWait = 10'000'000'000;  // ns; a timeout only costs memory

bool softwareDriver() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = text != nullptr ? text : "";
    return renderer.find("llvmpipe") != std::string_view::npos;
}

}  // namespace

SubmissionPacer::SubmissionPacer() : batch_(softwareDriver() ? softwareBatch : 0) {}

SubmissionPacer::~SubmissionPacer() {
    for (const GLsync fence : fences_) glDeleteSync(fence);
}

void SubmissionPacer::submitted(std::uint64_t triangles) {
    open_ += triangles;
    if (batch_ == 0 || open_ < batch_) return;
    open_ = 0;
    fences_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    if (fences_.size() <= openBatches) return;
    glClientWaitSync(fences_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, longestWait);
    glDeleteSync(fences_.front());
    fences_.pop_front();
}

}  // namespace defocus::engine
