#pragma once
// Limits the frame time while the view changes. Defines a list of qualities, each about twice as expensive as the one
// before, and chooses the quality of the next frame.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus::engine {

struct FrameQuality {
    double resolution = 1;       // rendered pixels per window pixel, along each axis
    std::uint32_t samples = 64;  // lens samples; 1: pinhole, without blur
    double thresholdBias = 1;    // multiplies the level-of-detail thresholds; > 1: coarser meshes
};

// Returns the qualities from the cheapest to the best. None has less than half the window's resolution or more than
// four times the usual level-of-detail thresholds, because outlines would then look jagged and broken. The cheapest
// quality is a pinhole image with sharp outlines.
inline std::span<const FrameQuality> frameQualities() {
    static constexpr FrameQuality qualities[] = {
        {0.5, 1, 4}, {0.5, 2, 4}, {0.5, 4, 4}, {0.5, 8, 4}, {0.5, 16, 4}, {1, 8, 4}, {1, 16, 2}, {1, 32, 1}, {1, 64, 1},
    };
    return qualities;
}

struct FrameBudget {
    double milliseconds = 16;  // time budget per frame, ms
    std::size_t rung = 3;      // index into frameQualities()
    [[nodiscard]] const FrameQuality& quality() const { return frameQualities()[rung]; }
};

// Returns the initial budget of a window. `software`: whether OpenGL runs on the CPU.
inline FrameBudget windowBudget(bool software) {
    return software ? FrameBudget{50, 2} : FrameBudget{};
}

// Chooses the quality of the next frame after a frame that took `measured` ms. Lowers the quality by as many rungs of
// frameQualities() as needed to meet the budget. Raises it by one rung if about twice the time fits into the budget.
// Otherwise keeps the rung, so that the quality doesn't flicker.
inline FrameBudget adapted(FrameBudget budget, double measured) {
    constexpr double tooSlow = 1.15;  // a frame that takes more than this multiple of the budget is too slow
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
