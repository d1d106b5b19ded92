#pragma once
// First surface hit by rays, computed exactly on the CPU by brute force: milliseconds per million triangles.

#include <optional>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

struct Hit {
    double distance = 0;  // m along the unit direction
    int object = -1;      // index into Pose::objects
};

// Returns the first hit along each direction from `origin`. Each object is posed once for all directions.
std::vector<std::optional<Hit>> firstHits(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                                          const std::vector<glm::dvec3>& directions);
std::optional<Hit> firstHit(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                            const glm::dvec3& direction);

}  // namespace defocus::engine
