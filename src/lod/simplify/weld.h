#pragma once
// Finds equal vertices, vertices at the same position, and groups of vertices with the same position and similar
// normals.

#include <glm/vec3.hpp>
#include <vector>

#include "lod/simplify/number.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Ids that are equal for equal vertices. They are assigned in order of first appearance.
template <typename Vertex, typename Id>
struct Welded {
    Numbered<Vertex, Id> id;
    Numbered<Id, Vertex> first;  // per id, the first vertex with this id
};
using WeldedPositions = Welded<MeshVertexNumber, PositionNumber>;
using WeldedVertices = Welded<FileVertexNumber, MeshVertexNumber>;

// Assigns equal ids to exactly equal positions. −0 equals 0; a position with NaN equals no other position.
WeldedPositions weldPositions(const std::vector<glm::vec3>& positions);

// Assigns equal ids to vertices whose attributes, including morph targets, are all bit-identical.
WeldedVertices weldVertices(const Mesh& mesh);

// For each vertex, the first vertex of the group that contains it.
using VertexGroups = Numbered<MeshVertexNumber, MeshVertexNumber>;

// Groups vertices that share a position and whose normals differ by at most one degree. A crease separates groups.
VertexGroups smoothingGroups(const std::vector<glm::vec3>& normals, const WeldedPositions& positions);

}  // namespace defocus::engine
