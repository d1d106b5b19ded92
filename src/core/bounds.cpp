#include "core/bounds.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace defocus::engine {

void Bounds::extend(const glm::dvec3& point) {
    minimum = glm::min(minimum, point);
    maximum = glm::max(maximum, point);
}

void Bounds::extend(const Bounds& other) {
    if (other.empty()) return;
    extend(other.minimum);
    extend(other.maximum);
}

std::array<glm::dvec3, 8> Bounds::corners() const {
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
        result[static_cast<std::size_t>(i)] = {(i & 1) != 0 ? maximum.x : minimum.x,
                                               (i & 2) != 0 ? maximum.y : minimum.y,
                                               (i & 4) != 0 ? maximum.z : minimum.z};
    return result;
}

bool isFinite(const glm::vec3& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix) {
    Bounds result;
    if (bounds.empty()) return result;
    for (const glm::dvec3& corner : bounds.corners()) result.extend(glm::dvec3(matrix * glm::dvec4(corner, 1.0)));
    return result;
}

}  // namespace defocus::engine
