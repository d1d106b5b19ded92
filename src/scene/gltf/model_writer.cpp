#include "scene/gltf/model_writer.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/bounds.h"
#include "core/error.h"
#include "core/file.h"

namespace defocus::engine::gltf {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and are copied from memory");

int appendValues(tinygltf::Model& model, const void* values, std::size_t count, std::size_t valueBytes, int type,
                 int component, int target) {
    if (model.buffers.empty()) model.buffers.emplace_back();
    std::vector<unsigned char>& buffer = model.buffers.front().data;
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = count * valueBytes;
    view.target = target;
    const auto* const bytes = static_cast<const unsigned char*>(values);
    buffer.insert(buffer.end(), bytes, bytes + view.byteLength);
    tinygltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    return static_cast<int>(model.accessors.size()) - 1;
}

int appendPositions(tinygltf::Model& model, const std::vector<glm::vec3>& positions) {
    const int number = appendVectors(model, positions);
    Bounds bounds;
    for (const glm::vec3& position : positions) bounds.extend(glm::dvec3(position));
    model.accessors.back().minValues = {bounds.minimum.x, bounds.minimum.y, bounds.minimum.z};
    model.accessors.back().maxValues = {bounds.maximum.x, bounds.maximum.y, bounds.maximum.z};
    return number;
}

int appendIndices(tinygltf::Model& model, const std::vector<std::uint32_t>& indices) {
    return appendValues(model, indices.data(), indices.size(), sizeof(std::uint32_t), TINYGLTF_TYPE_SCALAR,
                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

void writeModel(const std::filesystem::path& path, const tinygltf::Model& model) {
    PendingFile file(path);
    std::ofstream stream(file.temporaryPath(), std::ios::binary);
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    if (stream.tellp() > std::streamoff{std::numeric_limits<std::uint32_t>::max()})
        fail("{}: {} bytes exceed the maximum size of a .glb file", path.string(), std::streamoff{stream.tellp()});
    stream.close();
    if (!stream) fail("cannot write {}: {}", path.string(), std::strerror(errno));
    file.commit();
}

}  // namespace defocus::engine::gltf
