#pragma once
// Computes the luminance of linear Rec. 709 colours.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus::engine {

inline double luminance(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// Returns the luminance of a pixel with at least three channels.
inline double luminance(const float* pixel) {
    return luminance(glm::dvec3(pixel[0], pixel[1], pixel[2]));
}

}  // namespace defocus::engine
