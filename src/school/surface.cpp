#include "school/surface.h"

#include <glm/glm.hpp>

namespace defocus::engine {
namespace {

void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::vector<std::uint32_t>& indices) {
    indices.insert(indices.end(), {a, b, c});
}

// Returns the index of vertex `i` of a ring; i = count wraps around to the first vertex.
std::uint32_t onRing(const VertexRow& ring, std::uint32_t i) {
    return ring.first + (i == ring.count ? 0u : i);
}

// Adds the triangles between two open rows of vertices. Their front faces are seen from where row `a` lies above row
// `b` and both run from left to right. Each step uses the shorter diagonal, which avoids sheared triangles between rows
// that are shifted relative to each other.
void stitchRows(const VertexRow& a, const VertexRow& b, const std::vector<glm::vec3>& positions,
                std::vector<std::uint32_t>& indices) {
    std::uint32_t i = a.first;
    std::uint32_t j = b.first;
    const std::uint32_t lastA = a.first + a.count - 1;
    const std::uint32_t lastB = b.first + b.count - 1;
    while (i < lastA || j < lastB) {
        bool advanceA = i < lastA;
        if (i < lastA && j < lastB) {
            advanceA = glm::distance(positions[i + 1], positions[j]) <= glm::distance(positions[i], positions[j + 1]);
        }
        if (advanceA) {
            triangle(i, j, i + 1, indices);
            ++i;
        } else {
            triangle(i, j, j + 1, indices);
            ++j;
        }
    }
}

// Returns the vertices along the outline of a surface made of open rows (not rings), counter-clockwise as seen from the
// front.
std::vector<std::uint32_t> outline(const std::vector<VertexRow>& rows) {
    std::vector<std::uint32_t> loop;
    for (std::size_t r = 0; r < rows.size(); ++r) loop.push_back(rows[r].first);
    const VertexRow& last = rows.back();
    for (std::uint32_t i = 1; i < last.count; ++i) loop.push_back(last.first + i);
    for (std::size_t r = rows.size() - 1; r-- > 0;) {
        if (r > 0 || rows[0].count > 1) loop.push_back(rows[r].first + rows[r].count - 1);
    }
    for (std::uint32_t i = rows[0].count; i-- > 2;) loop.push_back(rows[0].first + i - 1);
    return loop;
}

}  // namespace

void stitchRings(const VertexRow& a, const VertexRow& b, std::vector<std::uint32_t>& indices) {
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    const auto countA = static_cast<float>(a.count);
    const auto countB = static_cast<float>(b.count);
    while (i < a.count || j < b.count) {
        // Positions of the midpoints of the next edges around rings a and b: (i + ½ + offset) / count, multiplied by
        // countA · countB.
        const float nextA = (static_cast<float>(i) + 0.5f + a.offset) * countB;
        const float nextB = (static_cast<float>(j) + 0.5f + b.offset) * countA;
        if (j >= b.count || (i < a.count && nextA <= nextB)) {
            triangle(onRing(a, i), onRing(b, j), onRing(a, i + 1), indices);
            ++i;
        } else {
            triangle(onRing(a, i), onRing(b, j), onRing(b, j + 1), indices);
            ++j;
        }
    }
}

void capRing(const VertexRow& a, std::uint32_t apex, bool apexBelow, std::vector<std::uint32_t>& indices) {
    for (std::uint32_t i = 0; i < a.count; ++i) {
        const std::uint32_t here = onRing(a, i);
        const std::uint32_t next = onRing(a, i + 1);
        if (apexBelow) {
            triangle(here, apex, next, indices);
        } else {
            triangle(apex, here, next, indices);
        }
    }
}

void stitchShell(const std::vector<VertexRow>& rows, std::uint32_t backOffset, const std::vector<glm::vec3>& positions,
                 std::vector<std::uint32_t>& indices) {
    const std::size_t begin = indices.size();
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) stitchRows(rows[r], rows[r + 1], positions, indices);
    const std::size_t end = indices.size();
    for (std::size_t i = begin; i < end; i += 3) {
        triangle(indices[i] + backOffset, indices[i + 2] + backOffset, indices[i + 1] + backOffset, indices);
    }
    const std::vector<std::uint32_t> loop = outline(rows);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t here = loop[i];
        const std::uint32_t next = loop[(i + 1) % loop.size()];
        triangle(here, here + backOffset, next + backOffset, indices);
        triangle(here, next + backOffset, next, indices);
    }
}

std::uint64_t ringTriangles(const std::vector<std::uint32_t>& counts) {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : counts) sum += 2u * std::uint64_t{count};
    return sum;
}

std::uint64_t shellTriangles(const std::vector<std::uint32_t>& counts) {
    std::uint64_t side = 0;
    for (std::size_t r = 0; r + 1 < counts.size(); ++r) side += std::uint64_t{counts[r]} + counts[r + 1] - 2u;
    // The outline consists of the edges of the first and last rows, and of two edges between each pair of consecutive
    // rows.
    const std::uint64_t outlineEdges = counts.front() + counts.back() - 2u + 2u * (counts.size() - 1u);
    return 2u * side + 2u * outlineEdges;
}

}  // namespace defocus::engine
