#pragma once
// Computes missing tangents for normal maps, similar to MikkTSpace (Mikkelsen 2008). A vertex tangent is the sum of the
// triangles' tangents, projected into the plane of the vertex normal and weighted by the angle at the vertex. Triangles
// with mirrored texture coordinates do not share vertices with unmirrored ones.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/vertex_block.h"

namespace defocus::engine {

// Returns `block` with tangents computed from its normals and texture coordinate set `uvSet` (0 or 1). Without texture
// coordinates, tangents are arbitrary. A vertex shared by triangles with mirrored and unmirrored texture coordinates is
// duplicated, and `indices` are updated. As in glTF, the bitangent cross(normal, tangent) · w points up in the image,
// opposite to v.
VertexBlock withTangents(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices, int uvSet);

}  // namespace defocus::engine
