// Source: glTF 2.0 specification, meshes (3.7.2).

#include "scene/gltf/write.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "scene/gltf/model_writer.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

namespace {

namespace tinygltf = gltf::tinygltf;

constexpr std::uint32_t unused = 0xffffffffu;

// The vertices and triangles of a mesh that are written to the file.
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

std::map<std::string, int> appendVertices(tinygltf::Model& model, Vertices vertices) {
    std::map<std::string, int> attributes;
    attributes["POSITION"] = gltf::appendPositions(model, vertices.positions);
    for (glm::vec3& normal : vertices.normals) normal = unitNormal(normal);
    if (!vertices.normals.empty()) attributes["NORMAL"] = gltf::appendVectors(model, vertices.normals);
    const auto appendUv = [&](const char* name, std::vector<glm::vec2>& uv) {
        for (glm::vec2& place : uv)
            if (!std::isfinite(place.x) || !std::isfinite(place.y)) place = glm::vec2(0);
        if (!uv.empty()) attributes[name] = gltf::appendVectors(model, uv);
    };
    appendUv("TEXCOORD_0", vertices.uv0);
    if (!vertices.uv0.empty()) appendUv("TEXCOORD_1", vertices.uv1);  // glTF forbids TEXCOORD_1 without TEXCOORD_0
    if (!vertices.colors.empty()) attributes["COLOR_0"] = gltf::appendVectors(model, vertices.colors);
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
    const std::map<std::string, int> attributes = appendVertices(model, gathered(mesh.vertices, written.vertices));
    for (const std::vector<std::uint32_t>& triangles : written.triangles) {
        tinygltf::Primitive& primitive = model.meshes.back().primitives.emplace_back();
        primitive.attributes = attributes;
        primitive.indices = gltf::appendIndices(model, triangles);
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
    }
    return model;
}

}  // namespace

void writeGlb(const std::filesystem::path& path, const Mesh& mesh) {
    gltf::writeModel(path, modelOf(mesh));
}

}  // namespace defocus::engine
