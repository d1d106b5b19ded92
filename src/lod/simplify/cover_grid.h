#pragma once
// Rasterises what a surface covers, seen from afar along one direction.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bounds.h"

namespace defocus::engine {

inline constexpr int wordBits = 64;  // cells in a word of a grid

// What a surface covers, on a square grid at right angles to a direction. Coordinates are in cells; the points that
// are looked at lie in their middles.
class CoverGrid {
public:
    // Lays `resolution`² cells over a ball around `box`; `resolution` is a multiple of 64.
    CoverGrid(const Bounds& box, const glm::dvec3& direction, int resolution);

    // Marks what triangles cover, seen from either side; each has three indices. Places are rounded to single
    // precision.
    void add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    // Marks the cells of a row from `first` up to, but not including, `end`.
    void mark(int row, int first, int end);

    // Returns the same grid with nothing covered.
    [[nodiscard]] CoverGrid emptied() const;

    [[nodiscard]] glm::dvec2 cellsOf(const glm::vec3& position) const;
    // False outside of the grid.
    [[nodiscard]] bool covers(const glm::dvec2& cells) const {
        if (!(cells.x >= 0 && cells.y >= 0 && cells.x < resolution_ && cells.y < resolution_)) return false;
        const auto column = static_cast<std::size_t>(cells.x);
        const std::size_t row = static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(resolution_) / wordBits;
        return (cells_[row + column / wordBits] >> column % wordBits & 1) != 0;
    }
    [[nodiscard]] double area() const;                   // object units squared
    [[nodiscard]] double cell() const { return cell_; }  // object units; 0 of an empty box
    [[nodiscard]] int resolution() const { return resolution_; }
    // Turns a vector in the grid's plane into one in space, of the same length.
    [[nodiscard]] glm::dvec3 inSpace(const glm::dvec2& along) const { return along.x * across_ + along.y * up_; }

private:
    [[nodiscard]] std::uint64_t* wordsOf(int row);
    [[nodiscard]] bool isMarked(int firstRow, int endRow, int first, int end);
    void cover(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c);

    glm::dvec3 centre_, across_, up_;
    double cell_ = 0;
    double perUnit_ = 0;  // cells
    int resolution_ = 0;
    std::vector<std::uint64_t> cells_;  // a bit each, row by row
};

// Covers a grid by the edges of triangles instead of the triangles. Edges between two triangles whose projections lie
// on either side of it needn't be given, so that of a fine surface only the edges at its outlines are.
class EdgeFill {
public:
    explicit EdgeFill(int resolution);

    // Adds an edge; `triangles` counts those to the left of it on its way from `from` to `to` less those to the right.
    // Places are in cells.
    void add(const glm::dvec2& from, const glm::dvec2& to, int triangles);
    // Marks what the triangles cover, and forgets the edges. Returns the number of cells.
    std::size_t fill(CoverGrid& grid);

private:
    std::size_t fillRow(CoverGrid& grid, int row);

    int resolution_;
    std::vector<std::int32_t> steps_;   // from the cell before to each cell, in triangles that cover it
    std::vector<std::uint64_t> edges_;  // a bit for each cell with a step, row by row
    int firstRow_, endRow_;             // of those with edges
};

}  // namespace defocus::engine
