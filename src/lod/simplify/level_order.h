#pragma once
// The order of a pyramid's vertices: by how long they survive, so that a level uses a prefix of them.

#include <cstdint>
#include <vector>

#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"

namespace defocus {

struct SurvivalOrder {
    std::vector<std::uint32_t> vertices;      // old numbers of the vertices that a level uses, in their new order
    std::vector<std::uint32_t> vertexCounts;  // of each level: the prefix that it uses
};

// Sorts vertices by the coarsest level that uses their position, and within by first use in that level; vertices at one
// position stay together. Rewrites the indices of `levels` (finest first) to the new numbers.
SurvivalOrder sortBySurvival(std::vector<TriangleSet>& levels, const Welded& positions);

}  // namespace defocus
