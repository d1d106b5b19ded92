#pragma once
// Divides the clusters of a level of detail into pieces for the occlusion test. A piece is a few neighbouring triangles
// with a bounding box. Clusters have up to 64 triangles, and their larger boxes would often extend in front of
// occluders.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

inline constexpr std::uint32_t maxPieceTriangles = 8;

struct IndexPiece {
    IndexRange indices;   // range in Pyramid::indices
    glm::vec3 centre{0};  // centre of the bounding box, object units
    glm::vec3 reach{0};   // half the side lengths of the box, object units
};

// Returns the pieces (groups of neighbouring triangles) of a primitive at a level of detail, in index order.
std::vector<IndexPiece> indexPieces(const Pyramid& pyramid, std::uint32_t level, std::uint32_t primitive);

}  // namespace defocus::engine
