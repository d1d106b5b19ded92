#pragma once
// A primitive's vertex attributes and morph targets as a VertexBlock. Internal to the loader.

#include "scene/gltf_draco.h"
#include "scene/gltf_source.h"
#include "scene/vertex_block.h"

namespace defocus::gltf {

// Reads what `primitive` names; `draco` (or nullptr) holds what is compressed. All attributes must have as many
// elements as POSITION. Normals are empty where the file has none; then its tangents are dropped too, as the standard
// says.
VertexBlock readAttributes(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco,
                           const std::string& what);

// Makes every value usable: positions must be finite (Error naming `what`); normals, tangents and weights get unit
// length or sum, and what is neither finite nor long enough is replaced.
void repair(Source& source, VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices,
            const std::string& what);

}  // namespace defocus::gltf
