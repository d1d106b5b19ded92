#pragma once
// Clusters: runs of a level's triangles that lie near each other and face about the same way, so that a frame can leave
// out a whole run at once when no lens sample shows any of it (plan/visibility.h).

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/simplify/level_order.h"

namespace defocus {

struct IndexRange {
    std::uint32_t first = 0;  // into Pyramid::indices
    std::uint32_t count = 0;  // a multiple of 3
};

// Object units, as the level has its vertices. Rounded so that all of it holds for the triangles' exact planes.
struct Cluster {
    IndexRange indices;       // within one primitive
    glm::vec3 centre{0};      // of a ball around the vertices
    float radius = 0;         // of the ball
    glm::vec3 axis{0, 0, 1};  // unit length, about which the triangles' unit normals n lie
    float leastCosine = -1;   // of the angle between an n and the axis
    float planes = 0;         // n·(p − centre) is at least this, p on the plane of n's triangle
    float leastAltitude = 0;  // of the triangles; those of which corners coincide draw nothing and don't count
};

inline constexpr std::uint32_t mostClusterTriangles = 64;

// Reorders the triangles within each primitive into clusters, mostly neighbours one after the other, and within each
// from neighbour to neighbour. `positions` are by the level's vertex numbers, and so are `places`, below `placeCount`:
// vertices at one place have one position. The clusters' ranges count from the level's first index and follow each
// other over all of it. Deterministic.
std::vector<Cluster> clusterTriangles(TriangleSet& level, const std::vector<glm::vec3>& positions,
                                      std::span<const std::uint32_t> places, std::size_t placeCount);

}  // namespace defocus
