#pragma once
// Normals for a level's own triangles. The normals of the vertices that survive darken thin fins and pick up single
// bumps of a fine relief; averages over the level's faces show what is left of the surface.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace defocus {

// Vertices at one position whose normals agree within a degree share one smoothing group; others keep a crease between
// them. `positions` numbers equal positions alike. One group number a vertex.
std::vector<std::uint32_t> smoothingGroups(const std::vector<glm::vec3>& normals,
                                           const std::vector<std::uint32_t>& positions);

// For the first `vertexCount` vertices: the area-weighted mean normal of the faces `indices` (triangles) around their
// smoothing group. Faces wound against the normals of their own corners count turned. A vertex without a proper face
// keeps `original`.
std::vector<glm::vec3> levelNormals(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& original,
                                    const std::vector<std::uint32_t>& groups, std::span<const std::uint32_t> indices,
                                    std::uint32_t vertexCount);

}  // namespace defocus
