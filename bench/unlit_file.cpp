// Source: glTF 2.0 specification, GLB file format (4) and meshes (3.7.2).

#include "unlit_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "eval/convergence/unlit_scene.h"

namespace defocus::engine {

namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

constexpr int floats = 5126;    // glTF's component types
constexpr int integers = 5125;  // unsigned, 32 bits

template <typename Value>
void append(Bytes& bytes, const Value& value) {
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// Appends values to the buffer, and returns the index of their accessor.
template <typename Value>
std::size_t addAccessor(Json& document, Bytes& buffer, const std::vector<Value>& values, const char* type,
                        int component) {
    const auto bytes = std::as_bytes(std::span(values));
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", values.size()},
                                     {"type", type}});
    return document["accessors"].size() - 1;
}

Json meshOf(const Mesh& mesh, Json& document, Bytes& buffer) {
    if (!mesh.morphTargets.empty()) fail("mesh \"{}\" has morph targets, which are not written", mesh.name);
    const std::size_t positions = addAccessor(document, buffer, mesh.vertices.positions, "VEC3", floats);
    const Bounds bounds = mesh.bounds();
    document["accessors"][positions]["min"] = {bounds.minimum.x, bounds.minimum.y, bounds.minimum.z};
    document["accessors"][positions]["max"] = {bounds.maximum.x, bounds.maximum.y, bounds.maximum.z};
    // Without normals, a reader of the file would give each triangle vertices of its own.
    const std::size_t normals = addAccessor(document, buffer, mesh.vertices.normals, "VEC3", floats);
    const std::size_t colours = addAccessor(document, buffer, mesh.vertices.colors, "VEC4", floats);
    Json primitives = Json::array();
    for (const Primitive& primitive : mesh.primitives) {
        const std::size_t indices = addAccessor(document, buffer, primitive.indices, "SCALAR", integers);
        primitives.push_back({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"COLOR_0", colours}}},
                              {"indices", indices},
                              {"material", primitive.material}});
    }
    return {{"primitives", primitives}};
}

Json materialOf(const Material& material) {
    const glm::vec4 colour = material.baseColorFactor;
    return {{"pbrMetallicRoughness", {{"baseColorFactor", {colour.r, colour.g, colour.b, colour.a}}}},
            {"doubleSided", material.doubleSided},
            {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
}

Json cameraOf(const View& view) {
    const Lens& lens = view.lens;
    const double tangent = tanHalfHorizontalFov(lens) * view.height / view.width;
    return {{"type", "perspective"},
            {"perspective", {{"yfov", 2 * std::atan(tangent)}, {"znear", view.nearPlane}}},
            {"extras",
             {{"fStop", lens.fStop},
              {"focusDistance", lens.focusDistance},
              {"horizontalAperture", lens.horizontalAperture}}}};
}

Json nodeOf(const glm::dmat4& matrix) {
    return {{"matrix", std::span(glm::value_ptr(matrix), 16)}};
}

Json documentOf(const PreparedFrame& frame, Bytes& buffer) {
    const Scene scene = unlitScene(*frame.scene);
    Json document = {{"asset", {{"version", "2.0"}, {"generator", "defocus"}}},
                     {"extensionsUsed", {"KHR_materials_unlit"}},
                     {"scene", 0},
                     {"cameras", {cameraOf(frame.view)}}};
    for (const Material& material : scene.materials) document["materials"].push_back(materialOf(material));
    std::map<int, std::size_t> meshes;  // index in the file by index in the scene, of the meshes that are drawn
    Json& nodes = document["nodes"];
    nodes.push_back(nodeOf(frame.view.worldFromCamera));
    nodes.back()["camera"] = 0;
    for (const Object& object : frame.world.pose.objects) {
        if (object.skinned()) fail("object \"{}\" has a skin, which is not written", object.name);
        const auto [found, added] = meshes.try_emplace(object.mesh, meshes.size());
        if (added)
            document["meshes"].push_back(meshOf(scene.meshes[static_cast<std::size_t>(object.mesh)], document, buffer));
        nodes.push_back(nodeOf(object.worldFromObject));
        nodes.back()["mesh"] = found->second;
    }
    Json roots = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
    document["scenes"] = {{{"nodes", roots}}};
    document["buffers"] = {{{"byteLength", buffer.size()}}};
    return document;
}

void appendChunk(Bytes& file, std::span<const std::byte> content, const char* type) {
    append(file, static_cast<std::uint32_t>(content.size()));
    file.insert(file.end(), reinterpret_cast<const std::byte*>(type), reinterpret_cast<const std::byte*>(type) + 4);
    file.insert(file.end(), content.begin(), content.end());
}

}  // namespace

void writeUnlitFile(const std::filesystem::path& path, const PreparedFrame& frame) {
    Bytes buffer;
    std::string text = documentOf(frame, buffer).dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    Bytes file;
    append(file, std::array<char, 4>{'g', 'l', 'T', 'F'});
    append(file, std::uint32_t{2});
    append(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()));
    appendChunk(file, std::as_bytes(std::span(text)), "JSON");
    appendChunk(file, buffer, "BIN\0");
    writeFile(path, file);
}

}  // namespace defocus::engine
