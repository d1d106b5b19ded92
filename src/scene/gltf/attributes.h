#pragma once
// A primitive's vertex attributes and morph targets as a VertexBlock. Internal to the loader.

#include "scene/gltf/draco.h"
#include "scene/gltf/source.h"
#include "scene/vertex_block.h"

namespace defocus::engine::gltf {

// Reads what `primitive` names; `draco` (or nullptr) holds what is compressed. All attributes must have as many
// elements as POSITION. Normals are empty where the file has none; then its tangents are dropped too, as the standard
// says.
VertexBlock readAttributes(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco,
                           const std::string& what);

// Leaves out the triangles of which a corner is not finite; how many.
std::uint64_t dropUnplaced(Source& source, const std::vector<glm::vec3>& positions,
                           std::span<std::vector<std::uint32_t>* const> indices);

// Makes every value usable where all positions are finite: normals, tangents and weights get unit length or sum, and
// what is neither finite nor long enough is replaced.
void repair(Source& source, VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

}  // namespace defocus::engine::gltf
