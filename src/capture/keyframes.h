#pragma once
// Numbers and points at key frames of a shot, and their interpolation.
//
// linear: straight from key to key. smooth: a cubic through the keys that starts and ends at rest (Steffen 1990). It
// never exceeds the neighbouring keys, so that a focus pull doesn't overshoot; with two keys it is 3t² − 2t³. Before
// the first key and after the last one, the nearest key's value holds.

#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

enum class Easing { linear, smooth };

template <typename Value>
struct Key {
    double frame = 0;  // may be fractional
    Value value{};
};

// Returns the interpolated value. `keys`: at least one, sorted by frame, with different frames.
double valueAt(const std::vector<Key<double>>& keys, Easing easing, double frame);
glm::dvec3 valueAt(const std::vector<Key<glm::dvec3>>& keys, Easing easing, double frame);

}  // namespace defocus::engine
