#include "lod/simplify/cover_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace defocus::engine {

namespace {

constexpr double gridMargin = 1.04;  // grid side / diagonal of the bounding box, with a small margin

// Returns the index of the first grid cell whose centre is at or after the coordinate `place`, at most `end`. Cell i
// has its centre at i. Returns 0 for NaN.
template <typename T>
int firstAt(T place, int end) {
    const T bounded = std::min(std::max(T{0}, place), static_cast<T>(end));
    const int truncated = static_cast<int>(bounded);
    return truncated + (static_cast<T>(truncated) < bounded ? 1 : 0);
}

// Returns a mask with the bits [low, high) set.
std::uint64_t bitsBetween(int low, int high) {
    return (~std::uint64_t{0} >> (wordBits - (high - low))) << low;
}

constexpr int fractionBits = 32;
constexpr std::int64_t almostOne = (std::int64_t{1} << fractionBits) - 1;

std::int64_t fixedPoint(double value) {
    constexpr double farthest = 1 << 20;
    return static_cast<std::int64_t>(std::clamp(value, -farthest, farthest) * static_cast<double>(almostOne + 1));
}

// Intersections of one side of a triangle with rows of the grid. The two triangles at an edge compute exactly the same
// intersections.
struct Side {
    float x, y, slope;

    Side(const glm::vec2& low, const glm::vec2& high)
        : x(low.x), y(low.y), slope((high.x - low.x) / (high.y - low.y)) {}
    [[nodiscard]] float at(float row) const { return x + (row - y) * slope; }
};

}  // namespace

CoverGrid::CoverGrid(const Bounds& box, const glm::dvec3& direction, int resolution)
    : centre_(box.centre()), cell_(gridMargin * glm::length(box.size()) / resolution), resolution_(resolution) {
    const glm::dvec3 other = std::abs(direction.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    across_ = glm::normalize(glm::cross(direction, other));
    up_ = glm::cross(direction, across_);
    perUnit_ = 1 / cell_;
    if (!(cell_ > 0) || !std::isfinite(cell_)) resolution_ = 0;
    cells_.assign(static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_) / wordBits, 0);
}

CoverGrid CoverGrid::emptied() const {
    CoverGrid result = *this;
    std::fill(result.cells_.begin(), result.cells_.end(), 0);
    return result;
}

glm::dvec2 CoverGrid::cellsOf(const glm::vec3& position) const {
    const glm::dvec3 p = (glm::dvec3(position) - centre_) * perUnit_;
    return 0.5 * resolution_ + glm::dvec2(glm::dot(p, across_), glm::dot(p, up_));
}

double CoverGrid::area() const {
    std::size_t count = 0;
    for (const std::uint64_t word : cells_) count += static_cast<std::size_t>(std::popcount(word));
    return cell_ * cell_ * static_cast<double>(count);
}

void CoverGrid::add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    if (resolution_ == 0) return;
    std::vector<glm::vec2> cells;  // positions in units of cells; cell centres lie at 0, 1, …
    cells.reserve(positions.size());
    for (const glm::vec3& position : positions) cells.emplace_back(cellsOf(position) - 0.5);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        cover(cells[indices[i]], cells[indices[i + 1]], cells[indices[i + 2]]);
}

std::uint64_t* CoverGrid::wordsOf(int row) {
    return &cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_) / wordBits];
}

void CoverGrid::mark(int row, int first, int end) {
    std::uint64_t* const words = wordsOf(row);
    for (int word = first / wordBits; wordBits * word < end; ++word) {
        const int low = std::max(first - wordBits * word, 0);
        const int high = std::min(end - wordBits * word, wordBits);
        if (low < high) words[word] |= bitsBetween(low, high);
    }
}

// Returns whether all cells in rows [firstRow, endRow) and columns [first, end) are marked as covered. Also returns
// false if the columns span more than one 64-bit word.
bool CoverGrid::isMarked(int firstRow, int endRow, int first, int end) {
    const int word = first / wordBits;
    if ((end - 1) / wordBits != word) return false;
    const std::uint64_t mask = bitsBetween(first - wordBits * word, end - wordBits * word);
    for (int row = firstRow; row < endRow; ++row)
        if ((wordsOf(row)[word] & mask) != mask) return false;
    return true;
}

void CoverGrid::cover(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    // Skip triangles that contain no cell centre, or only cells that are already covered. This skips most triangles of
    // a fine mesh.
    const int firstRow = firstAt(std::min(std::min(a.y, b.y), c.y), resolution_);
    const int endRow = firstAt(std::max(std::max(a.y, b.y), c.y), resolution_);
    if (firstRow >= endRow) return;
    const int first = firstAt(std::min(std::min(a.x, b.x), c.x), resolution_);
    const int end = firstAt(std::max(std::max(a.x, b.x), c.x), resolution_);
    if (first >= end || isMarked(firstRow, endRow, first, end)) return;
    if (!std::isfinite(a.x + a.y + b.x + b.y + c.x + c.y)) return;

    const glm::vec2* low = &a;
    const glm::vec2* middle = &b;
    const glm::vec2* high = &c;
    if (middle->y < low->y) std::swap(low, middle);
    if (high->y < middle->y) std::swap(middle, high);
    if (middle->y < low->y) std::swap(low, middle);
    const Side longSide(*low, *high);
    const auto between = [&](const Side& side, int from, int to) {
        for (int row = from; row < to; ++row) {
            const float one = longSide.at(static_cast<float>(row));
            const float other = side.at(static_cast<float>(row));
            mark(row, firstAt(std::min(one, other), resolution_), firstAt(std::max(one, other), resolution_));
        }
    };
    const int middleRow = firstAt(middle->y, resolution_);
    if (firstRow < middleRow) between(Side(*low, *middle), firstRow, middleRow);
    if (middleRow < endRow) between(Side(*middle, *high), middleRow, endRow);
}

EdgeFill::EdgeFill(int resolution) : resolution_(resolution), firstRow_(resolution), endRow_(0) {
    const std::size_t cells = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
    steps_.assign(cells, 0);
    edges_.assign(cells / wordBits, 0);
}

void EdgeFill::add(const glm::dvec2& from, const glm::dvec2& to, int triangles) {
    const bool up = from.y < to.y;
    const glm::dvec2& low = up ? from : to;
    const glm::dvec2& high = up ? to : from;
    const int first = firstAt(low.y - 0.5, resolution_);
    const int end = firstAt(high.y - 0.5, resolution_);
    if (first >= end) return;
    firstRow_ = std::min(firstRow_, first);
    endRow_ = std::max(endRow_, end);
    // Compute x in fixed point, so that the additions of `step` are exact.
    const double slope = (high.x - low.x) / (high.y - low.y);
    std::int64_t x = fixedPoint(low.x + (first + 0.5 - low.y) * slope - 0.5);
    const std::int64_t step = end - first > 1 ? fixedPoint(slope) : 0;
    const int sign = up ? -triangles : triangles;
    for (int row = first; row < end; ++row, x += step) {
        const auto column = static_cast<int>(std::max<std::int64_t>((x + almostOne) >> fractionBits, 0));
        if (column >= resolution_) continue;
        const std::size_t cell =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_) + static_cast<std::size_t>(column);
        steps_[cell] += sign;
        edges_[cell / wordBits] |= std::uint64_t{1} << cell % wordBits;
    }
}

std::size_t EdgeFill::fill(CoverGrid& grid) {
    std::size_t cells = 0;
    for (int row = firstRow_; row < endRow_; ++row) cells += fillRow(grid, row);
    firstRow_ = resolution_;
    endRow_ = 0;
    return cells;
}

std::size_t EdgeFill::fillRow(CoverGrid& grid, int row) {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_);
    std::size_t cells = 0;
    int triangles = 0;
    int first = 0;
    const auto markUntil = [&](int end) {
        grid.mark(row, first, end);
        cells += static_cast<std::size_t>(end - first);
    };
    for (int word = 0; word < resolution_ / wordBits; ++word) {
        std::uint64_t& edges = edges_[start / wordBits + static_cast<std::size_t>(word)];
        for (; edges != 0; edges &= edges - 1) {
            const int column = wordBits * word + std::countr_zero(edges);
            const int before = triangles;
            triangles += std::exchange(steps_[start + static_cast<std::size_t>(column)], 0);
            if (before != 0 && triangles == 0) markUntil(column);
            if (before == 0) first = column;
        }
    }
    if (triangles != 0) markUntil(resolution_);
    return cells;
}

}  // namespace defocus::engine
