#pragma once
// Groups triangles into clusters for culling (see Cluster). A cluster grows by one triangle at a time until it is full.
// Each added triangle touches the cluster, adds few vertices, and is similar to the cluster's triangles in position and
// orientation. meshoptimizer builds its meshlets by similar criteria. Triangles may have any shape and order.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/triangle_set.h"

namespace defocus::engine {

using LocalNumber = Number<struct LocalKind>;  // index of a distinct position within one primitive

struct GrownClusters {
    std::vector<TriangleNumber> triangles;  // grouped by cluster; consecutive triangles are mostly neighbours
    std::vector<std::uint32_t> sizes;       // number of triangles per cluster
};

// Groups triangles into clusters of at most `max` (≥ 1) triangles each. Corner positions are in object units and may be
// NaN or infinite. Deterministic.
GrownClusters growClusters(const Numbered<TriangleCorner, LocalNumber>& corners,
                           const Numbered<LocalNumber, glm::vec3>& positions, std::uint32_t max);

// Reorders the triangles of each primitive so that clusters are contiguous, and returns the clusters. Consecutive
// clusters are mostly neighbours, and so are consecutive triangles within a cluster. `positions` has the coordinates of
// each vertex. `places` has a number below `placeCount` for each vertex; vertices at the same position have the same
// number. The index ranges of the clusters are relative to the level's first index. Deterministic.
template <typename Vertex>
std::vector<Cluster> clusterTriangles(TriangleSet<Vertex>& level, std::span<const glm::vec3> positions,
                                      const Numbered<Vertex, PositionNumber>& places, std::size_t placeCount);

}  // namespace defocus::engine
