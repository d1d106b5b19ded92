#pragma once
// Computes the luminance of linear Rec. 709 colours.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus::engine {

inline double luminance(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace defocus::engine
