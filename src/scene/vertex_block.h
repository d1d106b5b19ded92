#pragma once
// Modifies vertex arrays while a mesh is read: gathers, compacts and flat-shades vertices, and appends vertices with
// different attributes.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh.h"

namespace defocus::engine {

struct VertexBlock {
    Vertices vertices;
    std::vector<MorphTarget> morphTargets;
};

// Returns the vertices with indices order[0], order[1], …; indices may repeat.
Vertices gathered(const Vertices& vertices, std::span<const std::uint32_t> order);
VertexBlock gathered(const VertexBlock& block, std::span<const std::uint32_t> order);

// Returns only the vertices that `indices` use, in order of first use, and updates `indices`.
VertexBlock compacted(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Returns the block with flat shading, which glTF requires for primitives without normals: each triangle gets its own
// vertices with its face normal. The normal of a triangle without area is +y. Morph targets get normal displacements
// that produce the face normals of the displaced triangles.
VertexBlock flatShaded(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Appends `block` to the mesh's vertices and returns the index of its first vertex. If an attribute is missing from
// either the mesh or the block, the vertices that lack it get a neutral value: normal +y, a perpendicular tangent, uv
// 0, white, the first joint, no displacement, or no added blur.
std::uint32_t append(Mesh& mesh, const VertexBlock& block);

// Returns an arbitrary unit vector perpendicular to the unit vector `normal`.
glm::vec3 perpendicular(const glm::vec3& normal);

}  // namespace defocus::engine
