#pragma once
// Cuts a level's clusters into pieces of a few neighbouring triangles, each with a bounding box. Clusters have up to 64
// triangles; their larger boxes would often reach in front of the occluder.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

inline constexpr std::uint32_t maxPieceTriangles = 8;

struct IndexPiece {
    IndexRange indices;   // into Pyramid::indices
    glm::vec3 centre{0};  // centre of the bounding box, object units
    glm::vec3 reach{0};   // half the side lengths of the box
};

// Returns the pieces of a primitive at a level, in index order.
std::vector<IndexPiece> indexPieces(const Pyramid& pyramid, std::uint32_t level, std::uint32_t primitive);

}  // namespace defocus::engine
