#pragma once
// Measures the time from an input event to the end of the frame that shows its effect. Includes the buffer swap, but
// not the delay of the compositor and the screen.
//
// The system reports when an event is fetched, not when it arrives. An event that arrives while a frame is drawn is
// dated to the previous fetch, so the measured times are upper bounds.

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <vector>

namespace defocus::engine {

class InputLatency {
public:
    using Time = std::chrono::steady_clock::time_point;

    // Records that events were fetched. `since`: earliest time at which they may have arrived. The effect of these
    // events may appear some frames later; the measured time begins with the earliest events whose effect has not
    // appeared yet.
    void arrived(Time since) {
        if (!waiting_) waiting_ = since;
    }
    // Records the end of a frame whose picture differs from the previous one.
    void shown(Time at) {
        if (!waiting_) return;
        answers_.push_back(std::chrono::duration<double, std::milli>(at - *waiting_).count());
        if (answers_.size() > maxAnswers) answers_.pop_front();
        waiting_.reset();
    }
    // Drops the recorded events, because they did not change the picture.
    void forget() { waiting_.reset(); }

    struct Summary {  // latencies in ms of the latest events whose effect was shown
        std::size_t count = 0;
        double latest = 0, median = 0, worst = 0;
    };
    [[nodiscard]] Summary summary() const {
        if (answers_.empty()) return {};
        std::vector<double> sorted(answers_.begin(), answers_.end());
        std::ranges::sort(sorted);
        return {sorted.size(), answers_.back(), sorted[sorted.size() / 2], sorted.back()};
    }

private:
    static constexpr std::size_t maxAnswers = 256;

    std::optional<Time> waiting_;
    std::deque<double> answers_;  // latencies of the latest events whose effect was shown, ms
};

}  // namespace defocus::engine
