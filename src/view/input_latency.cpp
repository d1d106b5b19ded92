#include "view/input_latency.h"

#include <algorithm>
#include <vector>

namespace defocus {

namespace {

constexpr std::size_t keptAnswers = 256;

}  // namespace

void InputLatency::arrived(Time since) {
    if (!waiting_) waiting_ = since;
}

void InputLatency::shown(Time at) {
    if (!waiting_) return;
    answers_.push_back(std::chrono::duration<double, std::milli>(at - *waiting_).count());
    if (answers_.size() > keptAnswers) answers_.pop_front();
    waiting_.reset();
}

InputLatency::Summary InputLatency::summary() const {
    if (answers_.empty()) return {};
    std::vector<double> sorted(answers_.begin(), answers_.end());
    std::sort(sorted.begin(), sorted.end());
    return {sorted.size(), answers_.back(), sorted[sorted.size() / 2], sorted.back()};
}

}  // namespace defocus
