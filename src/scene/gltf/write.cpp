// glTF 2.0 specification, 3.6 (buffers and accessors), 3.7.2 (meshes), 4 (the GLB container).

#include "scene/gltf/write.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/bounds.h"
#include "core/error.h"
#include "core/file.h"

namespace defocus {

namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

using Json = nlohmann::ordered_json;

constexpr int unsignedInt = 5125, floatType = 5126;
constexpr int vertexData = 34962, indexData = 34963;  // targets of buffer views
constexpr std::uint32_t unused = 0xffffffffu;
constexpr std::size_t headerBytes = 12, chunkHeaderBytes = 8;

// The vertices and triangles that are written.
struct Written {
    std::vector<std::uint32_t> vertices;                // of the mesh, in their new order
    std::vector<std::vector<std::uint32_t>> triangles;  // new numbers, one list a primitive that has any
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
                    fail("mesh \"{}\": index {} is beyond its {} vertices", mesh.name, corner[k],
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
    if (written.triangles.empty()) fail("mesh \"{}\": it has no triangle that a glTF file could hold", mesh.name);
    return written;
}

// Unit length also after rounding to floats.
glm::vec3 unitNormal(const glm::vec3& normal) {
    const glm::dvec3 wide = normal;
    const double length = glm::length(wide);
    if (!(length > 0) || !std::isfinite(length)) return {0, 1, 0};
    return glm::vec3(wide / length);
}

class GlbBuilder {
public:
    explicit GlbBuilder(const std::string& name) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "defocus"}};
        json_["scene"] = 0;
        json_["scenes"] = {{{"nodes", {0}}}};
        json_["nodes"] = Json::array({{{"mesh", 0}}});
        json_["meshes"] = Json::array({Json::object()});
        if (!name.empty()) {
            json_["nodes"][0]["name"] = name;
            json_["meshes"][0]["name"] = name;
        }
        for (const char* list : {"accessors", "bufferViews"}) json_[list] = Json::array();
        json_["meshes"][0]["primitives"] = Json::array();
    }

    // A buffer view of its own for the values, whose size is a multiple of 4, and an accessor of it; returns the
    // latter's number.
    template <typename T>
    int add(const std::vector<T>& values, int componentType, const char* type, int target, const Json& more = {}) {
        static_assert(sizeof(T) % 4 == 0);
        const std::size_t offset = binary_.size();
        const std::size_t bytes = values.size() * sizeof(T);
        binary_.resize(offset + bytes);
        std::memcpy(&binary_[offset], values.data(), bytes);
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}});
        Json accessor = {{"bufferView", json_["bufferViews"].size() - 1},
                         {"componentType", componentType},
                         {"count", values.size()},
                         {"type", type}};
        if (!more.is_null()) accessor.update(more);
        json_["accessors"].push_back(accessor);
        return static_cast<int>(json_["accessors"].size()) - 1;
    }

    void addPrimitive(const Json& attributes, int indices) {
        json_["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"indices", indices}});
    }

    [[nodiscard]] std::vector<std::byte> bytes(const std::string& name) {
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        // A name that isn't UTF-8 must not end the export.
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t total = headerBytes + 2 * chunkHeaderBytes + text.size() + binary_.size();
        if (total > std::numeric_limits<std::uint32_t>::max())
            fail("mesh \"{}\": {} bytes are more than a .glb file can hold", name, total);
        std::vector<std::byte> file(total);
        std::byte* end = file.data();
        end = append(end, "glTF", 4);
        for (const std::size_t value : {std::size_t{2}, total, text.size()}) end = appendWord(end, value);
        end = append(end, "JSON", 4);
        end = append(end, text.data(), text.size());
        end = appendWord(end, binary_.size());
        end = append(end, "BIN", 4);
        append(end, binary_.data(), binary_.size());
        return file;
    }

private:
    static std::byte* append(std::byte* end, const void* bytes, std::size_t count) {
        std::memcpy(end, bytes, count);
        return end + count;
    }
    static std::byte* appendWord(std::byte* end, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        return append(end, &word, sizeof word);
    }

    Json json_;
    std::vector<std::byte> binary_;
};

template <typename T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<std::uint32_t>& vertices) {
    std::vector<T> result;
    result.reserve(vertices.size());
    for (const std::uint32_t v : vertices) result.push_back(values[v]);
    return result;
}

Json limitsOf(const std::vector<glm::vec3>& positions) {
    glm::vec3 least = positions.front();
    glm::vec3 most = positions.front();
    for (const glm::vec3& p : positions) {
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
    return {{"min", {least.x, least.y, least.z}}, {"max", {most.x, most.y, most.z}}};
}

Json addVertices(GlbBuilder& builder, const Vertices& vertices, const std::vector<std::uint32_t>& order) {
    Json attributes;
    const std::vector<glm::vec3> positions = chosen(vertices.positions, order);
    attributes["POSITION"] = builder.add(positions, floatType, "VEC3", vertexData, limitsOf(positions));
    if (!vertices.normals.empty()) {
        std::vector<glm::vec3> normals = chosen(vertices.normals, order);
        for (glm::vec3& normal : normals) normal = unitNormal(normal);
        attributes["NORMAL"] = builder.add(normals, floatType, "VEC3", vertexData);
    }
    const auto addUv = [&](const char* name, const std::vector<glm::vec2>& values) {
        if (values.empty()) return;
        std::vector<glm::vec2> uv = chosen(values, order);
        for (glm::vec2& place : uv)
            if (!std::isfinite(place.x) || !std::isfinite(place.y)) place = glm::vec2(0);
        attributes[name] = builder.add(uv, floatType, "VEC2", vertexData);
    };
    addUv("TEXCOORD_0", vertices.uv0);
    if (!vertices.uv0.empty()) addUv("TEXCOORD_1", vertices.uv1);  // sets are numbered without a gap
    if (!vertices.colors.empty())
        attributes["COLOR_0"] = builder.add(chosen(vertices.colors, order), floatType, "VEC4", vertexData);
    return attributes;
}

}  // namespace

std::vector<std::byte> glbOf(const Mesh& mesh) {
    const Written written = chooseTriangles(mesh);
    GlbBuilder builder(mesh.name);
    const Json attributes = addVertices(builder, mesh.vertices, written.vertices);
    for (const std::vector<std::uint32_t>& triangles : written.triangles)
        builder.addPrimitive(attributes, builder.add(triangles, unsignedInt, "SCALAR", indexData));
    return builder.bytes(mesh.name);
}

void writeGlb(const std::filesystem::path& path, const Mesh& mesh) {
    writeFile(path, glbOf(mesh));
}

}  // namespace defocus
