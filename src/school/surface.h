#pragma once
// Closed triangle surfaces from rows of vertices that follow a shape's size: a row gets as many vertices as its length
// needs, and neighbouring rows of different counts are stitched like a zip. Triangles stay near-equilateral and of one
// size wherever the shape narrows, where a regular grid would make slivers.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

// `count` consecutive vertices from `first`. Closed rows (rings) are evenly spaced from `offset` (in steps, 0 … 1) all
// around; open rows are evenly spaced from end to end.
struct VertexRow {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    float offset = 0.0f;
};

// Triangles between two rings. Seen from outside, with `b` below `a`, the rings run from left to right.
void stitchRings(const VertexRow& a, const VertexRow& b, std::vector<std::uint32_t>& indices);

// Triangles between ring `a` and the single vertex `apex` below (`apexBelow`) or above it.
void capRing(const VertexRow& a, std::uint32_t apex, bool apexBelow, std::vector<std::uint32_t>& indices);

// A sheet of open rows as a closed thin shell. Vertex i of the sheet has its front copy at i and its back copy at
// i + `backOffset`; both sides are stitched and joined by a rim. Seen from the front, with each row below the one
// before, rows run from left to right. Only the first and the last row may have a single vertex.
void stitchShell(const std::vector<VertexRow>& rows, std::uint32_t backOffset, const std::vector<glm::vec3>& positions,
                 std::vector<std::uint32_t>& indices);

// Triangles that stitchRings and capRing (over all rings) or stitchShell make of rows of these counts.
std::uint64_t ringTriangles(const std::vector<std::uint32_t>& counts);
std::uint64_t shellTriangles(const std::vector<std::uint32_t>& counts);

}  // namespace defocus::engine
