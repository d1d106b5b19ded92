#pragma once
// Sorts vertices and triangles in memory. Before simplification, vertices that are close in space are placed close in
// memory. Afterwards, vertices are sorted by the coarsest level that uses them, so that each level uses a prefix of the
// vertex buffer.

#include <cstdint>
#include <vector>

#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"

namespace defocus::engine {

// Returns whether the vertices of one triangle and of consecutive triangles are so far apart in memory that caches help
// little. The limit is a mean index distance of 1.5·√n for n vertices. In a grid of n vertices stored row by row,
// neighbours are up to √n apart.
bool isScattered(const TriangleSet<MeshVertexNumber>& triangles, std::size_t vertexCount);
// Renumbers vertices so that vertices that are close in space are close in memory. `positions` are the positions of the
// file's vertices.
void sortSpatially(WeldedVertices& unique, const std::vector<glm::vec3>& positions);
// Sorts the triangles of each primitive by their smallest vertex index.
void sortSpatially(TriangleSet<MeshVertexNumber>& triangles);

struct SurvivalOrder {
    Numbered<PyramidVertexNumber, MeshVertexNumber> vertices;  // vertices that at least one level uses
    Numbered<MeshVertexNumber, PyramidVertexNumber> numbers;   // inverse of `vertices`; invalid for unused vertices
    std::vector<std::uint32_t> vertexCounts;                   // length of each level's prefix of the vertex buffer
};

// Sorts vertices by the coarsest level that uses their position, then by first use in that level. Vertices at the same
// position stay adjacent. `levels` starts with the finest level.
SurvivalOrder sortBySurvival(const std::vector<TriangleSet<MeshVertexNumber>>& levels,
                             const WeldedPositions& positions);

}  // namespace defocus::engine
