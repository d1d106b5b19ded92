#pragma once
// Interpolates numbers and points between the key frames of a shot.
//
// linear: straight lines between keys. smooth: a cubic through the keys with zero slope at the first and last key
// (Steffen 1990). The cubic stays within the values of the neighbouring keys, so that a focus pull doesn't overshoot.
// With only two keys, the curve is v₀ + (v₁ − v₀)·(3t² − 2t³), where t runs from 0 at the first key to 1 at the second.
// Before the first key and after the last key, the value is constant.

#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

enum class Easing { linear, smooth };

template <typename Value>
struct Key {
    double frame = 0;  // frame number, may be fractional
    Value value{};
};

// Returns the interpolated value at `frame`. `keys`: at least one, sorted by strictly increasing frame.
double valueAt(const std::vector<Key<double>>& keys, Easing easing, double frame);
glm::dvec3 valueAt(const std::vector<Key<glm::dvec3>>& keys, Easing easing, double frame);

}  // namespace defocus::engine
