#pragma once
// Numbers and points given at some frames of a shot, and what they are in between.
//
// linear: straight from key to key. smooth: a cubic through the keys that starts and ends at rest and never swings
// beyond the keys around it (Steffen 1990), so that a focus pull doesn't overshoot; with two keys it is 3t² − 2t³.
// Before the first key and after the last one their values hold.

#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

enum class Easing { linear, smooth };

template <typename Value>
struct Key {
    double frame = 0;  // may lie between frames
    Value value{};
};

// At least one key, in order of their frames, no two at the same frame.
double valueAt(const std::vector<Key<double>>& keys, Easing easing, double frame);
glm::dvec3 valueAt(const std::vector<Key<glm::dvec3>>& keys, Easing easing, double frame);

}  // namespace defocus::engine
