#pragma once
// Moves the focus smoothly from one distance to another, slowly at both ends. The motion is computed in dioptres (1/m),
// because the circle of confusion is linear in them.

#include <algorithm>
#include <cmath>

#include "plan/motion/camera_path.h"

namespace defocus::engine {

// Returns 3t² − 2t³ for t clamped to [0, 1]; its slope at both ends is 0.
inline double eased(double t) {
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

struct FocusPull {
    double from = 1;  // start distance in m, > 0; may be infinite
    double to = 1;
    double begin = 0;       // start time in s, on any clock
    double duration = 0.4;  // duration in s

    [[nodiscard]] bool over(double now) const { return now >= begin + duration; }
    // Returns the focus distance (m) at the time `now` (s); exactly `to` after the end of the pull.
    [[nodiscard]] double distanceAt(double now) const {
        return over(now) ? to : focusBetween(from, to, eased((now - begin) / duration));
    }
};

// Returns the focus distance after `notches` of the mouse wheel; positive notches focus farther. Each notch multiplies
// the distance by a constant factor.
inline double rackedFocus(double focusDistance, double notches) {
    constexpr double step = 0.03;         // relative change of the distance per notch
    constexpr double minDistance = 1e-3;  // min focus distance, m
    constexpr double maxDistance = 1e6;   // max focus distance, m
    if (!std::isfinite(focusDistance)) return notches < 0 ? maxDistance : focusDistance;
    return std::clamp(focusDistance * std::exp(step * notches), minDistance, maxDistance);
}

}  // namespace defocus::engine
