#pragma once
// Rasterizes the area that a surface covers in parallel projection along a given direction.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bounds.h"

namespace defocus::engine {

inline constexpr int wordBits = 64;  // grid cells per 64-bit word of the bit mask

// Coverage of a surface on a square grid perpendicular to a direction. Coordinates are in units of cells; coverage is
// tested at cell centres.
class CoverGrid {
public:
    // Creates an empty grid of `resolution`² cells over a bounding sphere of `box`. `resolution` is a multiple of 64.
    CoverGrid(const Bounds& box, const glm::dvec3& direction, int resolution);

    // Marks the cells that triangles cover, regardless of orientation. Three indices form a triangle. Projected
    // positions are rounded to single precision.
    void add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    // Marks the cells [first, end) of row `row` as covered.
    void mark(int row, int first, int end);

    // Returns an empty grid with the same direction, cell size and resolution.
    [[nodiscard]] CoverGrid emptied() const;

    [[nodiscard]] glm::dvec2 cellsOf(const glm::vec3& position) const;
    // Returns whether the grid cell that contains the point `cells` (in units of cells) is covered; false outside the
    // grid.
    [[nodiscard]] bool covers(const glm::dvec2& cells) const {
        if (!(cells.x >= 0 && cells.y >= 0 && cells.x < resolution_ && cells.y < resolution_)) return false;
        const auto column = static_cast<std::size_t>(cells.x);
        const std::size_t row = static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(resolution_) / wordBits;
        return (cells_[row + column / wordBits] >> column % wordBits & 1) != 0;
    }
    [[nodiscard]] double area() const;                   // covered area, object units squared
    [[nodiscard]] double cell() const { return cell_; }  // side of a cell, object units; 0 for an empty box
    [[nodiscard]] int resolution() const { return resolution_; }
    // Converts a vector in the plane of the grid to a vector of the same length in object space.
    [[nodiscard]] glm::dvec3 inSpace(const glm::dvec2& along) const { return along.x * across_ + along.y * up_; }

private:
    [[nodiscard]] std::uint64_t* wordsOf(int row);
    [[nodiscard]] bool isMarked(int firstRow, int endRow, int first, int end);
    void cover(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c);

    glm::dvec3 centre_, across_, up_;
    double cell_ = 0;
    double perUnit_ = 0;  // cells per object unit
    int resolution_ = 0;
    std::vector<std::uint64_t> cells_;  // one bit per cell, row by row
};

// Rasterizes coverage from edges instead of triangles. An edge may be omitted if its two triangles project to opposite
// sides of it. A fine surface therefore needs only the edges at its outlines.
class EdgeFill {
public:
    explicit EdgeFill(int resolution);

    // Adds an edge between two positions, given in units of cells. `triangles` is the number of triangles to the left
    // of the edge, looking from `from` to `to`, minus the number of triangles to its right.
    void add(const glm::dvec2& from, const glm::dvec2& to, int triangles);
    // Marks the covered cells in `grid`, removes all edges, and returns the number of covered cells.
    std::size_t fill(CoverGrid& grid);

private:
    std::size_t fillRow(CoverGrid& grid, int row);

    int resolution_;
    std::vector<std::int32_t> steps_;  // per cell: number of covering triangles minus that of the previous cell
    // One bit per cell, row by row; 1 if an edge contributed to the cell's entry of `steps_`.
    std::vector<std::uint64_t> edges_;
    int firstRow_, endRow_;  // range [firstRow_, endRow_) of rows with edges
};

}  // namespace defocus::engine
