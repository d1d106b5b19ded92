#pragma once
// Tangents for normal maps if a file has none, similar to MikkTSpace (Mikkelsen 2008). Corner tangents are weighted by
// angle and projected into the plane of the vertex normal. Triangles with mirrored texture coordinates get vertices of
// their own.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/vertex_block.h"

namespace defocus::engine {

// Returns `block` with tangents from its normals and texture coordinates `uvSet` (0 or 1); arbitrary tangents without
// coordinates. A vertex shared by mirrored and unmirrored triangles is duplicated, and `indices` are updated. As in
// glTF, bitangent = cross(normal, tangent) · w points up in the image, against v.
VertexBlock withTangents(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices, int uvSet);

}  // namespace defocus::engine
