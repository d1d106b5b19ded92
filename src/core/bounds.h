#pragma once
// Axis-aligned bounding box in double precision (scenes may lie 1e7 m from the origin).

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

// Whether a box can hold the point: no coordinate is infinite or NaN.
[[nodiscard]] bool isFinite(const glm::vec3& point);

// The box around the eight transformed corners of `bounds`; empty stays empty.
Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix);

}  // namespace defocus::engine
