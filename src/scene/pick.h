#pragma once
// The first surface along a ray, by brute force over all triangles of the scene (exact, no GPU; milliseconds a million
// triangles).

#include <optional>

#include "scene/pose.h"

namespace defocus {

struct Hit {
    double distance = 0;  // m along the unit direction
    int object = -1;      // into Pose::objects
};

std::optional<Hit> firstHit(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                            const glm::dvec3& direction);

}  // namespace defocus
