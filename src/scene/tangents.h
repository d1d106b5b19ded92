#pragma once
// Tangents for normal maps where a file has none, in the manner of MikkTSpace (Mikkelsen 2008): per corner, weighted by
// the corner's angle, projected into the plane of the vertex normal; mirrored texture coordinates never share a vertex.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/vertex_block.h"

namespace defocus::engine {

// `block` with tangents from its normals and texture coordinates (`uvSet` 0 or 1; without any, tangents are arbitrary).
// A vertex that mirrored and plain triangles share is doubled, and `indices` follow. w as glTF has it: bitangent =
// cross(normal, tangent) · w points up in the image, against v.
VertexBlock withTangents(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices, int uvSet);

}  // namespace defocus::engine
