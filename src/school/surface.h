#pragma once
// Builds closed triangle surfaces from rows of vertices. Each row has as many vertices as its length requires. Rows
// with different vertex counts are joined by zipper triangulation. Triangles stay nearly equilateral and of equal size
// even where the shape narrows; a regular grid would create slivers there.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

// Row of `count` consecutive vertices from index `first`. Vertices of a closed row (ring) are evenly spaced; its first
// vertex lies `offset` steps (0 to 1) after the ring's start. Vertices of an open row are evenly spaced from end to
// end.
struct VertexRow {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    float offset = 0.0f;
};

// Adds the triangles between two rings. Seen from outside with ring `b` below ring `a`, the vertices of both rings run
// from left to right.
void stitchRings(const VertexRow& a, const VertexRow& b, std::vector<std::uint32_t>& indices);

// Adds the triangles between ring `a` and the single vertex `apex`, which lies below the ring if `apexBelow` is set,
// else above it.
void capRing(const VertexRow& a, std::uint32_t apex, bool apexBelow, std::vector<std::uint32_t>& indices);

// Turns a surface made of open rows into a thin closed shell. Vertex i of the surface has its front copy at index i and
// its back copy at i + `backOffset`; a rim joins both sides. Seen from the front, rows follow each other downwards, and
// vertices run from left to right. Only the first and the last row may have a single vertex.
void stitchShell(const std::vector<VertexRow>& rows, std::uint32_t backOffset, const std::vector<glm::vec3>& positions,
                 std::vector<std::uint32_t>& indices);

// ringTriangles() returns the number of triangles that stitchRings and capRing create for rings with these vertex
// counts. shellTriangles() returns the number of triangles that stitchShell creates for open rows, which are not rings,
// with these vertex counts.
std::uint64_t ringTriangles(const std::vector<std::uint32_t>& counts);
std::uint64_t shellTriangles(const std::vector<std::uint32_t>& counts);

}  // namespace defocus::engine
