#pragma once
// Sorts elements along a Morton curve (Z-order), so that elements close in the order are close in space (Lauterbach et
// al. 2009, Fast BVH Construction on GPUs).

#include <cstdint>
#include <glm/vec3.hpp>

#include "core/memory.h"

namespace defocus::engine {

inline constexpr double maxMortonCell = 1023;  // max index of a grid cell per axis: 10 bits

// Returns the Morton code, 30 bits, of the grid cell that contains `point`, which is in units of the cell size.
// Coordinates are clamped to [0, maxMortonCell]; NaN counts as 0.
std::uint32_t mortonCode(const glm::dvec3& point);

// Sorts the keys by the Morton code in their upper 32 bits (radix sort). Keys with equal codes keep their order.
void sortByMortonCode(LargeVector<std::uint64_t>& keys);

}  // namespace defocus::engine
