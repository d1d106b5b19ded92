// Source: glTF 2.0 specification, buffers and accessors (3.6) and meshes (3.7.2).

#include "scene/gltf/write.h"

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/bounds.h"
#include "core/error.h"
#include "core/file.h"
#include "scene/gltf/tinygltf.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

namespace tinygltf = gltf::tinygltf;

constexpr std::uint32_t unused = 0xffffffffu;

// Vertices and triangles of the mesh that are written.
struct Written {
    std::vector<std::uint32_t> vertices;                // indices into the mesh's vertices, in output order
    std::vector<std::vector<std::uint32_t>> triangles;  // output vertex indices; one list per primitive with triangles
};

Written chooseTriangles(const Mesh& mesh) {
    Written written;
    std::vector<std::uint32_t> newNumber(mesh.vertices.count(), unused);
    for (const Primitive& primitive : mesh.primitives) {
        std::vector<std::uint32_t> list;
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const std::uint32_t* corner = &primitive.indices[i];
            bool proper = true;
            for (int k = 0; k < 3; ++k) {
                if (corner[k] >= mesh.vertices.count())
                    fail("mesh \"{}\": index {} is out of range; there are {} vertices", mesh.name, corner[k],
                         mesh.vertices.count());
                proper = proper && isFinite(mesh.vertices.positions[corner[k]]);
            }
            for (int k = 0; k < 3 && proper; ++k) {
                std::uint32_t& number = newNumber[corner[k]];
                if (number == unused) {
                    number = static_cast<std::uint32_t>(written.vertices.size());
                    written.vertices.push_back(corner[k]);
                }
                list.push_back(number);
            }
        }
        if (!list.empty()) written.triangles.push_back(std::move(list));
    }
    if (written.triangles.empty()) fail("mesh \"{}\": the mesh has no triangle that can be written as glTF", mesh.name);
    return written;
}

// Normalises a vector in double precision; returns +y for a zero or non-finite vector.
glm::vec3 unitNormal(const glm::vec3& normal) {
    const glm::dvec3 wide = normal;
    const double length = glm::length(wide);
    if (!(length > 0) || !std::isfinite(length)) return {0, 1, 0};
    return glm::vec3(wide / length);
}

// Appends `values` as a new buffer view with an accessor, and returns the accessor's index. `type` is a TINYGLTF_TYPE_…
// constant.
template <typename T>
int append(tinygltf::Model& model, const std::vector<T>& values, int type, int componentType, int target) {
    static_assert(sizeof(T) % 4 == 0);
    std::vector<unsigned char>& buffer = model.buffers.front().data;
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
    buffer.insert(buffer.end(), bytes, bytes + view.byteLength);
    tinygltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = componentType;
    accessor.count = values.size();
    accessor.type = type;
    return static_cast<int>(model.accessors.size()) - 1;
}

template <typename Vector>
int appendVectors(tinygltf::Model& model, const std::vector<Vector>& values) {
    static_assert(TINYGLTF_TYPE_VEC2 == 2 && TINYGLTF_TYPE_VEC3 == 3 && TINYGLTF_TYPE_VEC4 == 4);
    return append(model, values, Vector::length(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
}

int appendPositions(tinygltf::Model& model, const std::vector<glm::vec3>& positions) {
    const int number = appendVectors(model, positions);
    Bounds bounds;
    for (const glm::vec3& position : positions) bounds.extend(glm::dvec3(position));
    model.accessors.back().minValues = {bounds.minimum.x, bounds.minimum.y, bounds.minimum.z};
    model.accessors.back().maxValues = {bounds.maximum.x, bounds.maximum.y, bounds.maximum.z};
    return number;
}

std::map<std::string, int> appendVertices(tinygltf::Model& model, Vertices vertices) {
    std::map<std::string, int> attributes;
    attributes["POSITION"] = appendPositions(model, vertices.positions);
    for (glm::vec3& normal : vertices.normals) normal = unitNormal(normal);
    if (!vertices.normals.empty()) attributes["NORMAL"] = appendVectors(model, vertices.normals);
    const auto appendUv = [&](const char* name, std::vector<glm::vec2>& uv) {
        for (glm::vec2& place : uv)
            if (!std::isfinite(place.x) || !std::isfinite(place.y)) place = glm::vec2(0);
        if (!uv.empty()) attributes[name] = appendVectors(model, uv);
    };
    appendUv("TEXCOORD_0", vertices.uv0);
    if (!vertices.uv0.empty()) appendUv("TEXCOORD_1", vertices.uv1);  // glTF does not allow set 1 without set 0
    if (!vertices.colors.empty()) attributes["COLOR_0"] = appendVectors(model, vertices.colors);
    return attributes;
}

// Returns `text` with invalid UTF-8 bytes replaced, because nlohmann::json throws when it writes them.
std::string utf8(const std::string& text) {
    using Json = nlohmann::json;
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

tinygltf::Model modelOf(const Mesh& mesh) {
    const Written written = chooseTriangles(mesh);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "defocus";
    model.defaultScene = 0;
    model.scenes.emplace_back().nodes = {0};
    model.nodes.emplace_back().mesh = 0;
    model.nodes.back().name = utf8(mesh.name);
    model.meshes.emplace_back().name = model.nodes.back().name;
    model.buffers.emplace_back();
    const std::map<std::string, int> attributes = appendVertices(model, gathered(mesh.vertices, written.vertices));
    for (const std::vector<std::uint32_t>& triangles : written.triangles) {
        tinygltf::Primitive& primitive = model.meshes.back().primitives.emplace_back();
        primitive.attributes = attributes;
        primitive.indices = append(model, triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
    }
    return model;
}

}  // namespace

void writeGlb(const std::filesystem::path& path, const Mesh& mesh) {
    const tinygltf::Model model = modelOf(mesh);
    PendingFile file(path);
    std::ofstream stream(file.temporaryPath(), std::ios::binary);
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    if (stream.tellp() > std::streamoff{std::numeric_limits<std::uint32_t>::max()})
        fail("mesh \"{}\": {} bytes exceed the maximum size of a .glb file", mesh.name, std::streamoff{stream.tellp()});
    stream.close();
    if (!stream) fail("cannot write {}: {}", path.string(), std::strerror(errno));
    file.commit();
}

}  // namespace defocus::engine
