#pragma once
// Measures and fits the area that a surface covers, seen from afar. A coarse level whose vertices lie on a bulging
// surface covers too little of it, and a thin fin shrinks at its rim; no blur hides either. So the outlines of coarse
// levels are fitted to those of level 0, on grids of points along some directions.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/cover_grid.h"

namespace defocus::engine {

// Half of the directions to the 26 neighbours in a cube, because a surface covers the same area from the opposite side.
// Unit length.
inline constexpr std::size_t outlineDirections = 13;
std::array<glm::dvec3, outlineDirections> directionsOfOutlines();

// Returns the grids of level 0, one for each direction.
std::vector<CoverGrid> outlinesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                  const Bounds& box);

// Moves vertices along the outlines of a level until it covers about what `outlines` do, within `box`, unless it
// already does to within half a per cent from each direction. Moves are as small as that allows. Vertices with
// equal numbers in `places` (below positions.size()) stay together. It turns no triangle by more than 60°.
void fitOutlines(std::span<glm::vec3> positions, std::span<const std::uint32_t> indices,
                 std::span<const std::uint32_t> places, std::span<const CoverGrid> outlines, const Bounds& box);

}  // namespace defocus::engine
