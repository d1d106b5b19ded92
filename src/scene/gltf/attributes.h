#pragma once
// Reads a primitive's vertex attributes and morph targets as a VertexBlock. Internal to the glTF loader.

#include "scene/gltf/draco.h"
#include "scene/gltf/source.h"
#include "scene/vertex_block.h"

namespace defocus::engine::gltf {

// Returns the attributes of `primitive`, which are read from `draco` if it is not nullptr. Without normals in the file,
// normals are empty and tangents are dropped, as glTF requires. Throws Error, with `what` in its message, unless all
// attributes have as many elements as POSITION.
VertexBlock readAttributes(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco,
                           const std::string& what);

// Removes triangles with a NaN or infinite position and returns their number.
std::uint64_t dropUnplaced(Source& source, const std::vector<glm::vec3>& positions,
                           std::span<std::vector<std::uint32_t>* const> indices);

}  // namespace defocus::engine::gltf
