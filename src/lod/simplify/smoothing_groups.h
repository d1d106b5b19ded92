#pragma once
// Which vertices at one position share a normal, and which keep a crease between them.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace defocus {

// Vertices at one position whose normals agree within a degree share one group; others keep a crease between them.
// `positions` numbers equal positions alike. The result holds one group number a vertex: the group's first vertex.
std::vector<std::uint32_t> smoothingGroups(const std::vector<glm::vec3>& normals,
                                           const std::vector<std::uint32_t>& positions);

}  // namespace defocus
