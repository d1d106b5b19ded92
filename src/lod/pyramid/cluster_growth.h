#pragma once
// Clusters grown from triangle to triangle: each takes in what touches it, adds no vertices if possible and lies and
// faces most as it does, until it is full: choices of the kind that meshoptimizer's meshlets are made by. Neither shape
// nor order of the triangles matters to what may be one.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace defocus {

struct GrownClusters {
    std::vector<std::uint32_t> triangles;  // all, cluster after cluster, mostly neighbours one after the other
    std::vector<std::uint32_t> sizes;      // triangles of each cluster
};

// `corners` are three a triangle, all below positions.size(); the positions, in object units, may be anything. No
// cluster has more than `most` (1 or more) triangles. Deterministic.
GrownClusters growClusters(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions,
                           std::uint32_t most);

}  // namespace defocus
