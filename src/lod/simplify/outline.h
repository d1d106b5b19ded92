#pragma once
// Measures and fits the area that a surface covers in parallel projection. A coarse level covers too little area if its
// vertices lie on a convex surface, and thin fins shrink at their rims. Blur hides neither error. The outlines of
// coarse levels are therefore fitted to those of level 0, on grids of sample points for several directions.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/cover_grid.h"

namespace defocus::engine {

// Directions of projection: unit vectors from the centre cell of a 3 × 3 × 3 cube to half of the 26 other cells. The
// other half is redundant, because a surface covers the same area from the opposite side.
inline constexpr std::size_t outlineDirections = 13;
std::array<glm::dvec3, outlineDirections> directionsOfOutlines();

// Returns, for each projection direction, the grid of the cells that level 0 covers.
std::vector<CoverGrid> outlinesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                  const Bounds& box);

// Moves the vertices on a level's outlines outwards or inwards until the level covers approximately the same area as
// level 0, whose covered cells are `outlines`. Does nothing if the areas already agree within 0.5 % in every direction.
// Displacements are as small as possible, and vertices stay within `box`. Vertices with equal values in `places` share
// a position, on entry and on return. These values are below positions.size(). No triangle rotates by more than 60°.
void fitOutlines(std::span<glm::vec3> positions, std::span<const std::uint32_t> indices,
                 std::span<const std::uint32_t> places, std::span<const CoverGrid> outlines, const Bounds& box);

}  // namespace defocus::engine
