#pragma once
// Finds the first surface that a ray hits, on the CPU. A single ray is tested against all triangles, which takes
// milliseconds per million triangles. For many rays, each mesh is first sorted into groups of neighbouring triangles
// with bounding boxes.

#include <optional>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

struct Hit {
    double distance = 0;  // distance in m from the ray's origin
    int object = -1;      // index into Pose::objects
};

// Returns the first hit of a ray from `origin` along each direction; nullopt if the ray hits nothing. Each object is
// posed only once.
std::vector<std::optional<Hit>> firstHits(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                                          const std::vector<glm::dvec3>& directions);
std::optional<Hit> firstHit(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                            const glm::dvec3& direction);

}  // namespace defocus::engine
