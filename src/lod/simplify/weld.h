#pragma once
// Finds vertices that are the same, vertices at the same place, and those of them that share a normal.

#include <glm/vec3.hpp>
#include <vector>

#include "lod/simplify/number.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Equal vertices have one number, in order of first appearance.
template <typename Vertex, typename Id>
struct Welded {
    Numbered<Vertex, Id> id;
    Numbered<Id, Vertex> first;  // the first vertex that has the id
};
using WeldedPositions = Welded<MeshVertexNumber, PositionNumber>;
using WeldedVertices = Welded<FileVertexNumber, MeshVertexNumber>;

// Welds exactly equal positions (−0 equals 0; a position that is no number equals none).
WeldedPositions weldPositions(const std::vector<glm::vec3>& positions);

// Welds vertices of which every attribute is equal to the last bit, morph targets included.
WeldedVertices weldVertices(const Mesh& mesh);

// For each vertex, the first vertex of its group.
using VertexGroups = Numbered<MeshVertexNumber, MeshVertexNumber>;

// Vertices at one position whose normals agree within a degree share one group; others keep a crease between them.
VertexGroups smoothingGroups(const std::vector<glm::vec3>& normals, const WeldedPositions& positions);

}  // namespace defocus::engine
