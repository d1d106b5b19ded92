#pragma once
// Cuts a level's clusters into pieces of a few neighbouring triangles, each with a box. Clusters have up to 64
// triangles, and a box around so many reaches in front of what hides them.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

inline constexpr std::uint32_t maxPieceTriangles = 8;

struct IndexPiece {
    IndexRange indices;   // of Pyramid::indices
    glm::vec3 centre{0};  // of the box around the triangles, object units
    glm::vec3 reach{0};   // half of its sides
};

// Returns the pieces of a primitive at a level, in the order of their indices.
std::vector<IndexPiece> indexPieces(const Pyramid& pyramid, std::uint32_t level, std::uint32_t primitive);

}  // namespace defocus::engine
