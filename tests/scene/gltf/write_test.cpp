#include "scene/gltf/write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "scene/gltf/gltf.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

// Returns a mesh of two primitives with five vertices, of which the first is unused. The values have no short decimal
// representation.
Mesh twoPrimitives() {
    Mesh mesh;
    mesh.name = "bent \"sheet\"";
    mesh.vertices.positions = {{9, 9, 9}, {0.1f, 0.2f, 0.3f}, {1e-7f, 1, 1.0f / 3}, {-1e6f, 0, 0}, {2, 2, 2}};
    mesh.vertices.normals = {{0, 1, 0}, {0, 0.5f, 0}, {0.3f, 0, 0.4f}, {1, 0, 0}, {0, 0, -1}};
    mesh.vertices.uv0 = {{0, 0}, {0.1f, -3}, {1, 1}, {0.25f, 0.75f}, {7, 7}};
    mesh.vertices.uv1 = {{0, 0}, {0.5f, 0.5f}, {0, 1}, {1, 0}, {1, 1}};
    mesh.vertices.colors = {
        {0, 0, 0, 0}, {0.1f, 0.0018f, 0.3f, 1}, {1, 1e-6f, 0.5f, 0.7f}, {0, 0.99f, 0, 1}, {1, 1, 1, 1}};
    mesh.primitives = {{0, {1, 2, 3}}, {1, {2, 4, 3, 1, 4, 2}}};
    return mesh;
}

Mesh readBack(const Mesh& mesh) {
    const ScratchFolder folder;
    writeGlb(folder / "mesh.glb", mesh);
    const Scene scene = loadGltf(folder / "mesh.glb");
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.roots.size(), 1u);
    return scene.meshes.at(0);
}

template <typename T>
T cornerOf(const Mesh& mesh, const std::vector<T>& values, std::size_t primitive, std::size_t i) {
    return values.at(mesh.primitives.at(primitive).indices.at(i));
}

TEST(GltfWrite, ReadsBackTheSameTrianglesAndAttributes) {
    const Mesh mesh = twoPrimitives();
    const Mesh read = readBack(mesh);
    EXPECT_EQ(read.name, mesh.name);
    EXPECT_EQ(read.vertices.count(), 4u);
    ASSERT_EQ(read.primitives.size(), 2u);
    for (std::size_t p = 0; p < 2; ++p) {
        ASSERT_EQ(read.primitives[p].indices.size(), mesh.primitives[p].indices.size());
        for (std::size_t i = 0; i < mesh.primitives[p].indices.size(); ++i) {
            EXPECT_EQ(cornerOf(read, read.vertices.positions, p, i), cornerOf(mesh, mesh.vertices.positions, p, i));
            EXPECT_EQ(cornerOf(read, read.vertices.uv0, p, i), cornerOf(mesh, mesh.vertices.uv0, p, i));
            EXPECT_EQ(cornerOf(read, read.vertices.uv1, p, i), cornerOf(mesh, mesh.vertices.uv1, p, i));
            EXPECT_EQ(cornerOf(read, read.vertices.colors, p, i), cornerOf(mesh, mesh.vertices.colors, p, i));
            const glm::vec3 normal = glm::normalize(cornerOf(mesh, mesh.vertices.normals, p, i));
            EXPECT_LT(glm::distance(cornerOf(read, read.vertices.normals, p, i), normal), 1e-6f);
        }
    }
}

struct Glb {
    nlohmann::json json;
    std::vector<std::byte> binary;
};

std::uint32_t wordAt(const std::vector<std::byte>& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

// Returns the chunks of a GLB file, split according to the standard and independently of the loader.
Glb parts(const std::vector<std::byte>& file) {
    EXPECT_EQ(wordAt(file, 0), 0x46546c67u);
    EXPECT_EQ(wordAt(file, 4), 2u);
    EXPECT_EQ(wordAt(file, 8), file.size());
    const std::size_t length = wordAt(file, 12);
    EXPECT_EQ(length % 4, 0u);
    EXPECT_EQ(wordAt(file, 16), 0x4e4f534au);
    const auto* text = reinterpret_cast<const char*>(file.data() + 20);
    EXPECT_EQ(wordAt(file, 20 + length) % 4, 0u);
    EXPECT_EQ(wordAt(file, 24 + length), 0x004e4942u);
    EXPECT_EQ(28 + length + wordAt(file, 20 + length), file.size());
    return {nlohmann::json::parse(text, text + length),
            {file.begin() + static_cast<std::ptrdiff_t>(28 + length), file.end()}};
}

TEST(GltfWrite, FileIsWhatTheStandardAsks) {
    const ScratchFolder folder;
    writeGlb(folder / "mesh.glb", twoPrimitives());
    const Glb glb = parts(readFile(folder / "mesh.glb"));
    EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.binary.size());
    for (const auto& view : glb.json["bufferViews"]) {
        const std::size_t offset = view.value("byteOffset", std::size_t{0});
        EXPECT_EQ(offset % 4, 0u);
        EXPECT_LE(offset + view["byteLength"].get<std::size_t>(), glb.binary.size());
        EXPECT_GT(view["byteLength"], 0);
    }
    const auto& primitives = glb.json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    for (const auto& primitive : primitives) {
        const auto& position = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
        EXPECT_EQ(position["count"], 4);
        EXPECT_EQ(position["min"][0].get<float>(), -1e6f);
        EXPECT_EQ(position["min"][2].get<float>(), 0.0f);
        EXPECT_EQ(position["max"][1].get<float>(), 2.0f);
    }
    const auto& normal = glb.json["accessors"][primitives[0]["attributes"]["NORMAL"].get<std::size_t>()];
    const auto& view = glb.json["bufferViews"][normal["bufferView"].get<std::size_t>()];
    for (std::size_t i = 0; i < 4; ++i) {
        glm::vec3 n;
        std::memcpy(&n, glb.binary.data() + view["byteOffset"].get<std::size_t>() + i * sizeof n, sizeof n);
        EXPECT_NEAR(glm::length(glm::dvec3(n)), 1, 1e-6);
    }
}

TEST(GltfWrite, LeavesOutWhatTheStandardForbids) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Mesh mesh = twoPrimitives();
    mesh.vertices.positions[4].x = nan;      // invalidates a vertex that is shared by both triangles of primitive 1
    mesh.vertices.normals[1] = {0, 0, 0};    // zero length
    mesh.vertices.normals[2] = {nan, 1, 0};  // NaN
    mesh.vertices.uv0[3] = {std::numeric_limits<float>::infinity(), 0};
    const Mesh read = readBack(mesh);
    ASSERT_EQ(read.primitives.size(), 1u);
    EXPECT_EQ(read.vertices.count(), 3u);
    EXPECT_EQ(cornerOf(read, read.vertices.normals, 0, 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(cornerOf(read, read.vertices.normals, 0, 1), glm::vec3(0, 1, 0));
    EXPECT_EQ(cornerOf(read, read.vertices.uv0, 0, 2), glm::vec2(0));
}

TEST(GltfWrite, NothingToWriteAndBrokenIndicesAreErrors) {
    Mesh mesh;
    mesh.name = "void";
    const ScratchFolder folder;
    const auto message = [&] { return messageOf<Error>([&] { writeGlb(folder / "mesh.glb", mesh); }); };
    EXPECT_NE(message().find("void"), std::string::npos);
    mesh = twoPrimitives();
    mesh.primitives[0].indices[2] = 5;
    EXPECT_NE(message().find("index 5"), std::string::npos);
    EXPECT_NE(messageOf<Error>([] { writeGlb("/nowhere/mesh.glb", twoPrimitives()); }).find("/nowhere/mesh.glb"),
              std::string::npos);
}

TEST(GltfWrite, NameThatIsNoTextIsReplaced) {
    Mesh mesh = twoPrimitives();
    mesh.name = "bad \xff name";
    EXPECT_EQ(readBack(mesh).primitives.size(), 2u);
}

}  // namespace
}  // namespace defocus::engine
