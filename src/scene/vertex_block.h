#pragma once
// Vertices on their way into a mesh: picked, multiplied, joined to others that have different attributes.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh.h"

namespace defocus::engine {

struct VertexBlock {
    Vertices vertices;
    std::vector<MorphTarget> morphTargets;
};

// The vertices `order[0]`, `order[1]`, … of the others; an index may come several times or never.
Vertices gathered(const Vertices& vertices, std::span<const std::uint32_t> order);
VertexBlock gathered(const VertexBlock& block, std::span<const std::uint32_t> order);

// Keeps the vertices that `indices` use, in the order of their first use, and renumbers.
VertexBlock compacted(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Flat shading as glTF asks for without normals: every triangle gets vertices of its own with its face's normal. A
// triangle without area gets +y. Morph targets turn the normals to those of their own faces.
VertexBlock flatShaded(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Appends `block` to the mesh's vertices and returns the index of its first. What only one side has is filled with
// neutral values on the other: normal +y, a tangent perpendicular to the normal, uv 0, white, the first joint, no
// displacement, the lens's blur.
std::uint32_t append(Mesh& mesh, const VertexBlock& block);

// Any unit vector perpendicular to the unit vector `normal`.
glm::vec3 perpendicular(const glm::vec3& normal);

}  // namespace defocus::engine
