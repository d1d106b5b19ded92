#include "gl/pacer.h"

#include <algorithm>
#include <string_view>

namespace defocus::engine {

namespace {

constexpr std::size_t openBatches = 2;            // max number of undrawn batches while another batch is submitted
constexpr GLuint64 longestWait = 10'000'000'000;  // max wait in ns; after a timeout, drawing continues

bool softwareDriver() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = text != nullptr ? text : "";
    return renderer.find("llvmpipe") != std::string_view::npos;
}

}  // namespace

SubmissionPacer::SubmissionPacer(std::uint64_t bytes)
    : batch_(softwareDriver() ? std::max<std::uint64_t>(1, bytes / pendingTriangleBytes / (openBatches + 1)) : 0) {}

void SubmissionPacer::submitted(std::uint64_t triangles) {
    open_ += triangles;
    if (batch_ == 0 || open_ < batch_) return;
    open_ = 0;
    fences_.push_back(Fence::here());
    if (fences_.size() <= openBatches) return;
    fences_.front().wait(longestWait);
    fences_.pop_front();
}

}  // namespace defocus::engine
