#pragma once
// A primitive's vertex attributes and morph targets as a VertexBlock. Internal to the loader.

#include "scene/gltf/draco.h"
#include "scene/gltf/source.h"
#include "scene/vertex_block.h"

namespace defocus::engine::gltf {

// Reads the attributes of `primitive`; `draco` (or nullptr) holds its compressed data. All attributes must have as many
// elements as POSITION. Normals stay empty if the file has none; tangents are then dropped, as the standard requires.
VertexBlock readAttributes(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco,
                           const std::string& what);

// Removes triangles with a NaN or infinite corner and returns their number.
std::uint64_t dropUnplaced(Source& source, const std::vector<glm::vec3>& positions,
                           std::span<std::vector<std::uint32_t>* const> indices);

}  // namespace defocus::engine::gltf
