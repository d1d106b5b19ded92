#pragma once
// Measures and fits the area that a surface covers, seen from afar. A coarse level whose vertices lie on a bulging
// surface covers too little of it, and a thin fin shrinks at its rim; no blur hides either. So the outlines of coarse
// levels are fitted to those of level 0, on grids of points along some directions.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bounds.h"

namespace defocus {

// Half of the directions to the 26 neighbours in a cube, because a surface covers the same area from the opposite side.
// Unit length.
inline constexpr std::size_t outlineDirections = 13;
std::array<glm::dvec3, outlineDirections> directionsOfOutlines();

// What a surface covers, on a square grid at right angles to a direction. Coordinates are in cells; the points that
// are looked at lie in their middles.
class CoverGrid {
public:
    // Lays `resolution`² cells over a ball around `box`; `resolution` is a multiple of 64.
    CoverGrid(const Bounds& box, const glm::dvec3& direction, int resolution);

    // Marks what triangles cover, seen from either side; each has three indices.
    void add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

    // Returns the same grid with nothing covered.
    [[nodiscard]] CoverGrid emptied() const;

    [[nodiscard]] glm::dvec2 cellsOf(const glm::vec3& position) const;
    [[nodiscard]] bool covers(const glm::dvec2& cells) const;  // false outside of the grid
    [[nodiscard]] double area() const;                         // object units squared
    [[nodiscard]] double cell() const { return cell_; }        // object units; 0 of an empty box
    // Turns a vector in the grid's plane into one in space, of the same length.
    [[nodiscard]] glm::dvec3 inSpace(const glm::dvec2& along) const { return along.x * across_ + along.y * up_; }

private:
    void cover(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

    glm::dvec3 centre_, across_, up_;
    double cell_ = 0;
    int resolution_ = 0;
    std::vector<std::uint64_t> cells_;  // a bit each, row by row
};

// Returns the grids of level 0, one for each direction.
std::vector<CoverGrid> outlinesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                  const Bounds& box);

// Moves vertices along the outlines of a level until it covers about what `outlines` do, within `box`. Vertices with
// equal numbers in `places` (below positions.size()) stay together. It turns no triangle by more than 60°.
void fitOutlines(std::span<glm::vec3> positions, std::span<const std::uint32_t> indices,
                 std::span<const std::uint32_t> places, std::span<const CoverGrid> outlines, const Bounds& box);

}  // namespace defocus
