#pragma once
// Builds and writes tinygltf models whose data lies in one buffer. Source: glTF 2.0 specification, buffers and
// accessors (3.6).

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/gltf/tinygltf.h"

namespace defocus::engine::gltf {

// Appends `count` values of `valueBytes` bytes each to the model's first buffer, with a buffer view and an accessor,
// and returns the accessor's index. `type`, `component` and `target` are TINYGLTF_… constants; `valueBytes` is a
// multiple of 4.
int appendValues(tinygltf::Model& model, const void* values, std::size_t count, std::size_t valueBytes, int type,
                 int component, int target);

// Appends float vectors as appendValues does.
template <typename Vector>
int appendVectors(tinygltf::Model& model, const std::vector<Vector>& values) {
    static_assert(TINYGLTF_TYPE_VEC2 == 2 && TINYGLTF_TYPE_VEC3 == 3 && TINYGLTF_TYPE_VEC4 == 4);
    static_assert(sizeof(Vector) == 4 * static_cast<std::size_t>(Vector::length()));
    return appendValues(model, values.data(), values.size(), sizeof(Vector), Vector::length(),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
}
// Appends positions in m, and writes their bounds.
int appendPositions(tinygltf::Model& model, const std::vector<glm::vec3>& positions);
int appendIndices(tinygltf::Model& model, const std::vector<std::uint32_t>& indices);

// Writes the model atomically as .glb. Throws Error if writing fails or the file would exceed 4 GiB.
void writeModel(const std::filesystem::path& path, const tinygltf::Model& model);

}  // namespace defocus::engine::gltf
