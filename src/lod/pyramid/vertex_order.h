#pragma once
// Sorts vertices and triangles in memory. For the simplifier, what is near in space becomes near in memory. In the end
// vertices are sorted by how long they survive, so that a level uses a prefix of them.

#include <cstdint>
#include <vector>

#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"

namespace defocus::engine {

// Returns whether triangles that follow each other, and their corners, have numbers so far apart that caches are of
// little help. (On a grid in rows they are √n apart.)
bool isScattered(const TriangleSet<MeshVertexNumber>& triangles, std::size_t vertexCount);
// Numbers vertices anew, so that what is near in space is so in memory. `positions` are of the file's vertices.
void sortSpatially(WeldedVertices& unique, const std::vector<glm::vec3>& positions);
// Sorts the triangles of each primitive by the smallest of their vertices.
void sortSpatially(TriangleSet<MeshVertexNumber>& triangles);

struct SurvivalOrder {
    Numbered<PyramidVertexNumber, MeshVertexNumber> vertices;  // those that a level uses
    Numbered<MeshVertexNumber, PyramidVertexNumber> numbers;   // back; none for those that no level uses
    std::vector<std::uint32_t> vertexCounts;                   // of each level: the prefix that it uses
};

// Sorts vertices by the coarsest level that uses their position, and within by first use in that level; vertices at one
// position stay together. `levels` has the finest first.
SurvivalOrder sortBySurvival(const std::vector<TriangleSet<MeshVertexNumber>>& levels,
                             const WeldedPositions& positions);

}  // namespace defocus::engine
