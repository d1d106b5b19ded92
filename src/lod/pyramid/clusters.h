#pragma once
// Makes clusters (see Cluster). They grow from triangle to triangle: each takes in what touches it, adds no vertices if
// possible and lies and faces most as it does, until it is full: choices of the kind that meshoptimizer's meshlets are
// made by. Neither shape nor order of the triangles matters to what may be one.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/triangle_set.h"

namespace defocus::engine {

using LocalNumber = Number<struct LocalKind>;  // of the places that one primitive uses

struct GrownClusters {
    std::vector<TriangleNumber> triangles;  // all, cluster after cluster, mostly neighbours one after the other
    std::vector<std::uint32_t> sizes;       // triangles of each cluster
};

// The positions of the corners, in object units, may be anything. No cluster has more than `most` (1 or more)
// triangles. Deterministic.
GrownClusters growClusters(const Numbered<TriangleCorner, LocalNumber>& corners,
                           const Numbered<LocalNumber, glm::vec3>& positions, std::uint32_t max);

// Reorders the triangles within each primitive into clusters, mostly neighbours one after the other, and within each
// from neighbour to neighbour. `positions` and `places` have an entry a vertex; the places are below `placeCount`, and
// vertices at one place have one position. The clusters' ranges count from the level's first index and follow each
// other over all of it. Deterministic.
template <typename Vertex>
std::vector<Cluster> clusterTriangles(TriangleSet<Vertex>& level, std::span<const glm::vec3> positions,
                                      const Numbered<Vertex, PositionNumber>& places, std::size_t placeCount);

}  // namespace defocus::engine
