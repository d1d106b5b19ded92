#pragma once
// The first surface along rays, by brute force over all triangles of the scene (exact, no GPU; milliseconds a million
// triangles).

#include <optional>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

struct Hit {
    double distance = 0;  // m along the unit direction
    int object = -1;      // into Pose::objects
};

// Along each direction from `origin`; each object is posed once for all of them.
std::vector<std::optional<Hit>> firstHits(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                                          const std::vector<glm::dvec3>& directions);
std::optional<Hit> firstHit(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                            const glm::dvec3& direction);

}  // namespace defocus::engine
