#include "view/frame_budget.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace defocus {

namespace {

// Half the size and four times the thresholds are the least: with less, outlines break into steps and shards.
// One sample is a pinhole's, whose outlines are whole, too.
constexpr FrameQuality qualities[] = {
    {0.5, 1, 4}, {0.5, 2, 4}, {0.5, 4, 4}, {0.5, 8, 4}, {0.5, 16, 4}, {1, 8, 4}, {1, 16, 2}, {1, 32, 1}, {1, 64, 1},
};

}  // namespace

std::span<const FrameQuality> frameQualities() {
    return qualities;
}

FrameBudget adapted(FrameBudget budget, double measured) {
    constexpr double tooSlow = 1.15;  // of the budget
    constexpr double roomForTwice = 0.42;
    if (measured > tooSlow * budget.milliseconds) {
        const double doublings = std::log2(measured / budget.milliseconds);
        const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(doublings)));
        budget.rung -= std::min(budget.rung, steps);
    } else if (measured < roomForTwice * budget.milliseconds) {
        budget.rung = std::min(budget.rung + 1, std::size(qualities) - 1);
    }
    return budget;
}

}  // namespace defocus
