#pragma once
// Limits the time of a frame while the view changes: a ladder of qualities, each about twice as expensive as the one
// below, and the rule that picks the next rung.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus::engine {

struct FrameQuality {
    double resolution = 1;       // rendered pixels per window pixel along a side
    std::uint32_t samples = 64;  // 1: a pinhole, no blur
    double thresholdBias = 1;    // factor on the level-of-detail thresholds: coarser meshes
};

// Returns the qualities from the cheapest to the best. Below half the resolution or above four times the thresholds,
// outlines break into steps and shards. The cheapest quality is a pinhole image, whose outlines are sharp.
inline std::span<const FrameQuality> frameQualities() {
    static constexpr FrameQuality qualities[] = {
        {0.5, 1, 4}, {0.5, 2, 4}, {0.5, 4, 4}, {0.5, 8, 4}, {0.5, 16, 4}, {1, 8, 4}, {1, 16, 2}, {1, 32, 1}, {1, 64, 1},
    };
    return qualities;
}

struct FrameBudget {
    double milliseconds = 16;  // per frame
    std::size_t rung = 3;      // index into frameQualities()
    [[nodiscard]] const FrameQuality& quality() const { return frameQualities()[rung]; }
};

// Picks the rung for the next frame, after a frame on the current one took `measured` ms. It goes down at once by as
// many rungs as the frame was too slow, and up one rung if twice the cost would fit. In between it stays, so that the
// quality does not flicker.
inline FrameBudget adapted(FrameBudget budget, double measured) {
    constexpr double tooSlow = 1.15;  // of the budget
    constexpr double roomToClimb = 0.42;
    if (measured > tooSlow * budget.milliseconds) {
        const double doublings = std::log2(measured / budget.milliseconds);
        const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(doublings)));
        budget.rung -= std::min(budget.rung, steps);
    } else if (measured < roomToClimb * budget.milliseconds) {
        budget.rung = std::min(budget.rung + 1, frameQualities().size() - 1);
    }
    return budget;
}

}  // namespace defocus::engine
