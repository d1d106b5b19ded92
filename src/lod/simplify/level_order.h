#pragma once
// The order of a pyramid's vertices: by how long they survive, so that a level uses a prefix of them.

#include <cstdint>
#include <vector>

#include "lod/simplify/weld.h"

namespace defocus {

// Triangles of one level: primitive after primitive.
struct LevelTriangles {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> primitiveIndexCounts;
};

struct SurvivalOrder {
    std::vector<std::uint32_t> vertices;      // old vertex numbers in their new order; those that level 0 uses
    std::vector<std::uint32_t> vertexCounts;  // of each level: the prefix that it uses
};

// Sorts vertices by the coarsest level that uses their position, and within by first use in that level; vertices at one
// position stay together. Rewrites the indices of `levels` (finest first) to the new numbers.
SurvivalOrder sortBySurvival(std::vector<LevelTriangles>& levels, const Welded& positions);

}  // namespace defocus
