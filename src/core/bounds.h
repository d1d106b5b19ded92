#pragma once
// Axis-aligned bounding box in double precision, since scenes may lie 1e7 m from the origin.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace defocus::engine {

struct Bounds {
    glm::dvec3 minimum{std::numeric_limits<double>::infinity()};
    glm::dvec3 maximum{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool empty() const {
        return !(minimum.x <= maximum.x && minimum.y <= maximum.y && minimum.z <= maximum.z);
    }
    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * (minimum + maximum); }
    [[nodiscard]] glm::dvec3 size() const { return empty() ? glm::dvec3(0) : maximum - minimum; }

    void extend(const glm::dvec3& point);
    void extend(const Bounds& other);
    [[nodiscard]] std::array<glm::dvec3, 8> corners() const;
};

// Returns whether all coordinates are finite.
[[nodiscard]] bool isFinite(const glm::vec3& point);

// Returns the bounding box of the eight transformed corners of `bounds`; an empty box stays empty.
Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix);

}  // namespace defocus::engine
