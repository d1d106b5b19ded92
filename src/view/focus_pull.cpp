#include "view/focus_pull.h"

#include <algorithm>
#include <cmath>

namespace defocus {

double eased(double t) {
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

double FocusPull::distanceAt(double now) const {
    if (over(now)) return to;
    const double share = eased((now - begin) / duration);
    return 1 / ((1 - share) / from + share / to);
}

double rackedFocus(double focusDistance, double notches) {
    constexpr double step = 0.03;  // relative, a notch
    constexpr double nearest = 1e-3;
    constexpr double farthest = 1e6;
    if (!std::isfinite(focusDistance)) return notches < 0 ? farthest : focusDistance;
    return std::clamp(focusDistance * std::exp(step * notches), nearest, farthest);
}

}  // namespace defocus
