#pragma once
// How long people wait until the picture answers their hands: from an event to the end of the frame that shows what it
// changed, the swap of buffers included (not what a compositor or a screen adds).
//
// Systems don't say when an event arrived, only when it is fetched: one that came while a frame was drawn counts from
// the fetch before, so that these are upper bounds.

#include <chrono>
#include <deque>
#include <optional>

namespace defocus {

class InputLatency {
public:
    using Time = std::chrono::steady_clock::time_point;

    // Events were fetched: those of a person are there from `since` on at the latest. What they ask for may take some
    // frames to begin; the earliest that is unanswered counts.
    void arrived(Time since);
    // A frame that shows another picture is finished.
    void shown(Time at);
    // The events that are there ask for no other picture.
    void forget() { waiting_.reset(); }

    struct Summary {  // ms, of the latest answers
        std::size_t count = 0;
        double latest = 0, median = 0, worst = 0;
    };
    [[nodiscard]] Summary summary() const;

private:
    std::optional<Time> waiting_;
    std::deque<double> answers_;  // ms
};

}  // namespace defocus
