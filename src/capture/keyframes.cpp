// Implements the interpolation of Steffen 1990, A Simple Method for Monotonic Interpolation in One Dimension.

#include "capture/keyframes.h"

#include <algorithm>
#include <cmath>

namespace defocus::engine {

namespace {

double secant(const std::vector<Key<double>>& keys, std::size_t i) {
    return (keys[i + 1].value - keys[i].value) / (keys[i + 1].frame - keys[i].frame);
}

// Returns the slope at key i: Steffen 1990, equation 11; 0 at the first and the last key.
double slopeAt(const std::vector<Key<double>>& keys, std::size_t i) {
    if (i == 0 || i + 1 == keys.size()) return 0;
    const double before = secant(keys, i - 1);
    const double after = secant(keys, i);
    const double widthBefore = keys[i].frame - keys[i - 1].frame;
    const double widthAfter = keys[i + 1].frame - keys[i].frame;
    const double parabola = (before * widthAfter + after * widthBefore) / (widthBefore + widthAfter);
    if (before * after <= 0) return 0;
    const double min = std::min({std::abs(before), std::abs(after), 0.5 * std::abs(parabola)});
    return std::copysign(2 * min, before);
}

}  // namespace

double valueAt(const std::vector<Key<double>>& keys, Easing easing, double frame) {
    if (frame <= keys.front().frame) return keys.front().value;
    if (frame >= keys.back().frame) return keys.back().value;
    const auto next = std::ranges::upper_bound(keys, frame, {}, [](const Key<double>& key) { return key.frame; });
    const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
    const double width = keys[i + 1].frame - keys[i].frame;
    const double t = (frame - keys[i].frame) / width;
    const double from = keys[i].value;
    const double to = keys[i + 1].value;
    if (easing == Easing::linear) return (1 - t) * from + t * to;
    // Hermite cubic, written so that neighbouring keys of equal value give exactly that value.
    const double blend = t * t * (3 - 2 * t);
    const double ends = from + blend * (to - from);
    return ends + width * t * (1 - t) * ((1 - t) * slopeAt(keys, i) - t * slopeAt(keys, i + 1));
}

glm::dvec3 valueAt(const std::vector<Key<glm::dvec3>>& keys, Easing easing, double frame) {
    glm::dvec3 result;
    std::vector<Key<double>> component(keys.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < keys.size(); ++i) component[i] = {keys[i].frame, keys[i].value[axis]};
        result[axis] = valueAt(component, easing, frame);
    }
    return result;
}

}  // namespace defocus::engine
