#pragma once
// The mesh at unit size, so that no weight depends on its scale.

#include <glm/vec3.hpp>

namespace defocus {

struct Frame {
    glm::dvec3 centre{0};  // object units
    double inverse = 0;    // of the mesh's longest side in object units; 0: the mesh has no extent

    // A place of the mesh in the frame.
    [[nodiscard]] glm::dvec3 point(const glm::vec3& position) const {
        return (glm::dvec3(position) - centre) * inverse;
    }
    // The way between two places, in units of the frame.
    [[nodiscard]] glm::dvec3 step(const glm::vec3& from, const glm::vec3& to) const {
        return (glm::dvec3(to) - glm::dvec3(from)) * inverse;
    }
};

}  // namespace defocus
