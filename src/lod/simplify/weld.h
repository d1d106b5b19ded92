#pragma once
// Which vertices are the same? Numbers equal vertices alike, in order of first appearance.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/mesh.h"

namespace defocus {

struct Welded {
    std::vector<std::uint32_t> id;     // for each vertex
    std::vector<std::uint32_t> first;  // for each id the first vertex that has it
};

// Welds exactly equal positions (−0 equals 0; a position that is no number equals none).
Welded weldPositions(const std::vector<glm::vec3>& positions);

// Welds vertices of which every attribute is equal to the last bit, morph targets included.
Welded weldVertices(const Mesh& mesh);

}  // namespace defocus
