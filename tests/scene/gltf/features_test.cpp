// Tests features of core glTF 2.0 and of the supported extensions, each with a file of a few triangles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/bounds.h"
#include "core/error.h"
#include "scene/gltf/builder.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

using IndexList = std::vector<std::uint32_t>;

// Returns the corner positions of the first mesh's triangles, in order.
std::vector<glm::vec3> corners(const Scene& scene) {
    std::vector<glm::vec3> result;
    for (const Primitive& primitive : scene.meshes.at(0).primitives)
        for (const std::uint32_t index : primitive.indices) result.push_back(scene.meshes[0].vertices.positions[index]);
    return result;
}

// Positions of five vertices; the x coordinate is the index of the vertex.
const std::vector<float> numbered = {0, 0, 0, 1, 0, 1, 2, 0, 0, 3, 0, 1, 4, 0, 0};

std::vector<int> cornerNumbers(const Scene& scene) {
    std::vector<int> result;
    for (const glm::vec3& corner : corners(scene)) result.push_back(static_cast<int>(corner.x));
    return result;
}

TEST(GltfTopology, stripsKeepTheWinding) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(numbered)}}}, {"mode", 5}}});
    EXPECT_EQ(cornerNumbers(builder.load()), (std::vector<int>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(GltfTopology, stripsDropTheirStitches) {
    GltfBuilder builder;
    const int indices = builder.indices({0, 1, 2, 2, 3, 4});
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(numbered)}}}, {"indices", indices}, {"mode", 5}}});
    // The strip yields the triangles 0 1 2, (1 2 2), (2 2 3) and 2 4 3; degenerate triangles, in parentheses, are
    // dropped. The winding of every second triangle, such as the fourth, is reversed.
    EXPECT_EQ(cornerNumbers(builder.load()), (std::vector<int>{0, 1, 2, 2, 4, 3}));
}

TEST(GltfTopology, fansTurnAboutTheirFirstVertex) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(numbered)}}}, {"mode", 6}}});
    EXPECT_EQ(cornerNumbers(builder.load()), (std::vector<int>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfTopology, indicesOfEveryWidth) {
    for (const int type : {gltfUnsignedByte, gltfUnsignedShort, gltfUnsignedInt}) {
        GltfBuilder builder;
        const int view = type == gltfUnsignedByte    ? builder.view(std::vector<std::uint8_t>{2, 1, 4})
                         : type == gltfUnsignedShort ? builder.view(std::vector<std::uint16_t>{2, 1, 4})
                                                     : builder.view(std::vector<std::uint32_t>{2, 1, 4});
        const int indices = builder.accessor(view, type, "SCALAR", 3);
        builder.mesh({{{"attributes", {{"POSITION", builder.positions(numbered)}}}, {"indices", indices}}});
        const Scene scene = builder.load();
        EXPECT_EQ(cornerNumbers(scene), (std::vector<int>{2, 1, 4})) << type;
        EXPECT_EQ(scene.meshes[0].vertices.count(), 3u) << "vertices that no triangle uses are dropped";
    }
}

TEST(GltfTopology, primitivesThatShareAttributesShareVertices) {
    GltfBuilder builder;
    const int positions = builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const nlohmann::json attributes = {{"POSITION", positions}, {"NORMAL", normals}};
    builder.mesh({{{"attributes", attributes}, {"indices", builder.indices({0, 1, 2})}},
                  {{"attributes", attributes}, {"indices", builder.indices({2, 1, 3})}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.meshes[0].vertices.count(), 4u);
    ASSERT_EQ(scene.meshes[0].primitives.size(), 2u);
    EXPECT_EQ(scene.meshes[0].primitives[0].indices, (IndexList{0, 1, 2}));
    EXPECT_EQ(scene.meshes[0].primitives[1].indices, (IndexList{2, 1, 3}));
}

TEST(GltfTopology, missingAttributesOfOnePrimitiveAreNeutral) {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const int uv = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    const int colors = builder.floats({0, 0, 0, 0.5f, 0.5f, 0.5f, 2, -1, 1}, "VEC3", 3);
    builder.mesh({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}}},
                  {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"COLOR_0", colors}}}}});
    const Vertices vertices = builder.load().meshes[0].vertices;
    ASSERT_EQ(vertices.count(), 6u);
    EXPECT_EQ(vertices.colors,
              (std::vector<glm::vec4>{
                  {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}, {0.5f, 0.5f, 0.5f, 1}, {1, 0, 1, 1}}));
    EXPECT_EQ(vertices.uv0, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(GltfNormals, areFlatWhenTheFileHasNone) {
    // A square folded along its diagonal is flat-shaded. Its triangles must not share vertices, which would make the
    // shading smooth.
    GltfBuilder builder;
    const int positions = builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", builder.indices({0, 1, 2, 1, 3, 2})}}});
    const Vertices vertices = builder.load().meshes[0].vertices;
    ASSERT_EQ(vertices.count(), 6u);
    const glm::vec3 second = glm::normalize(glm::vec3(-1, -1, 1));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(vertices.normals[i], glm::vec3(0, 0, 1));
        EXPECT_NEAR(glm::dot(vertices.normals[3 + i], second), 1.0f, 1e-6f);
    }
}

TEST(GltfNormals, brokenOnesAreReplacedByTheFaces) {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    const int normals = builder.floats({0, 0, 0, std::nanf(""), 0, 1, 0, 0, 5}, "VEC3", 3);
    builder.mesh({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}}});
    const Scene scene = builder.load();
    for (const glm::vec3& normal : scene.meshes[0].vertices.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].count, 2u);
}

TEST(GltfMesh, trianglesWithoutAPlaceAreLeftOutAndCounted) {
    const float nan = std::nanf("");
    const float inf = std::numeric_limits<float>::infinity();
    GltfBuilder builder;
    const int positions = builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 0, -inf, 0});
    const int some = builder.indices({0, 1, 3, 0, 1, 2, 2, 4, 1});
    const int none = builder.indices({3, 4, 0});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", some}},
                  {{"attributes", {{"POSITION", positions}}}, {"indices", none}}});
    const Scene scene = builder.load();
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.triangleCount(), 1u);
    ASSERT_EQ(mesh.primitives.size(), 2u);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(mesh.vertices.positions.at(mesh.primitives[0].indices[static_cast<std::size_t>(i)]),
                  glm::vec3(i == 1, i == 2, 0));
    for (const glm::vec3& position : mesh.vertices.positions) EXPECT_TRUE(isFinite(position));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what, "triangles");
    EXPECT_EQ(scene.ignored[0].count, 3u);
    EXPECT_TRUE(scene.ignored[0].damage);
}

TEST(GltfAccessor, normalisedIntegersOfEveryType) {
    // Texture coordinates may be bytes or shorts, signed or unsigned, normalised or not.
    const auto load = [](int type, const auto& values, bool normalized) {
        GltfBuilder builder;
        const int positions = builder.positions(unitTriangle);
        const int uv = builder.accessor(builder.view(values, 4 * static_cast<int>(sizeof values[0])), type, "VEC2", 3,
                                        {{"normalized", normalized}});
        builder.mesh({{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}}}});
        return builder.load().meshes[0].vertices.uv0;
    };
    using Result = std::vector<glm::vec2>;
    const std::vector<std::uint8_t> bytes = {0, 255, 9, 9, 51, 102, 9, 9, 255, 0, 9, 9};
    EXPECT_EQ(load(gltfUnsignedByte, bytes, true), (Result{{0, 1}, {0.2f, 0.4f}, {1, 0}}));
    EXPECT_EQ(load(gltfUnsignedByte, bytes, false), (Result{{0, 255}, {51, 102}, {255, 0}}));
    const std::vector<std::int8_t> signedBytes = {-128, 127, 9, 9, -127, 0, 9, 9, 127, 0, 9, 9};
    EXPECT_EQ(load(gltfByte, signedBytes, true), (Result{{-1, 1}, {-1, 0}, {1, 0}}));
    const std::vector<std::uint16_t> shorts = {0, 65535, 9, 9, 13107, 0, 9, 9, 0, 0, 9, 9};
    EXPECT_EQ(load(gltfUnsignedShort, shorts, true), (Result{{0, 1}, {0.2f, 0}, {0, 0}}));
    const std::vector<std::int16_t> signedShorts = {-32768, 32767, 9, 9, -32767, 0, 9, 9, 0, 0, 9, 9};
    EXPECT_EQ(load(gltfShort, signedShorts, true), (Result{{-1, 1}, {-1, 0}, {0, 0}}));
    EXPECT_EQ(load(gltfShort, signedShorts, false), (Result{{-32768, 32767}, {-32767, 0}, {0, 0}}));
}

TEST(GltfAccessor, interleavedAttributesShareAView) {
    GltfBuilder builder;
    // 32 bytes per vertex: position, normal and uv
    const int view =
        builder.view(std::vector<float>{0, 0, 0, 0, 0, 1, 7, 8, 1, 0, 0, 0, 0, 1, 9, 10, 0, 1, 0, 0, 0, 1, 11, 12}, 32);
    const int positions = builder.accessor(view, gltfFloat, "VEC3", 3);
    const int normals = builder.accessor(view, gltfFloat, "VEC3", 3, {{"byteOffset", 12}});
    const int uv = builder.accessor(view, gltfFloat, "VEC2", 3, {{"byteOffset", 24}});
    builder.mesh({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}}}});
    const Vertices vertices = builder.load().meshes[0].vertices;
    EXPECT_EQ(vertices.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(vertices.uv0, (std::vector<glm::vec2>{{7, 8}, {9, 10}, {11, 12}}));
}

TEST(GltfAccessor, sparseElementsOverABaseAndOverZeros) {
    for (const bool base : {true, false}) {
        GltfBuilder builder;
        const int view = base ? builder.view(std::vector<float>{5, 5, 5, 1, 0, 0, 0, 1, 0}) : -1;
        const int indices = builder.view(std::vector<std::uint8_t>{0, 2});
        const int values = builder.view(std::vector<float>{7, 7, 7, 8, 8, 9});
        const nlohmann::json sparse = {{"count", 2},
                                       {"indices", {{"bufferView", indices}, {"componentType", gltfUnsignedByte}}},
                                       {"values", {{"bufferView", values}}}};
        builder.mesh(
            {{{"attributes", {{"POSITION", builder.accessor(view, gltfFloat, "VEC3", 3, {{"sparse", sparse}})}}}}});
        EXPECT_EQ(builder.load().meshes[0].vertices.positions,
                  (std::vector<glm::vec3>{{7, 7, 7}, {base ? 1 : 0, 0, 0}, {8, 8, 9}}));
    }
}

TEST(GltfAccessor, colorsOfSixteenBitsAreKept) {
    GltfBuilder builder;
    const int colors = builder.accessor(
        builder.view(std::vector<std::uint16_t>{0, 118, 129, 65535, 257, 386, 65535, 0, 32768, 0, 0, 32767}),
        gltfUnsignedShort, "VEC4", 3, {{"normalized", true}});
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}, {"COLOR_0", colors}}}}});
    const std::vector<glm::vec4> read = builder.load().meshes[0].vertices.colors;
    const std::vector<glm::dvec4> written = {{0, 118, 129, 65535}, {257, 386, 65535, 0}, {32768, 0, 0, 32767}};
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t v = 0; v < read.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) EXPECT_FLOAT_EQ(read[v][c], static_cast<float>(written[v][c] / 65535));
}

TEST(GltfAccessor, colorsOfFloatsAreKeptAndClampedToTheirRange) {
    GltfBuilder builder;
    const int colors = builder.floats({0.0018f, 1e-5f, 0.7f, 1, 1.5f, -0.5f, 0.3f, 0.1f, 0, 1, 0, 2}, "VEC4", 4);
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}, {"COLOR_0", colors}}}}});
    EXPECT_EQ(builder.load().meshes[0].vertices.colors,
              (std::vector<glm::vec4>{{0.0018f, 1e-5f, 0.7f, 1}, {1, 0, 0.3f, 0.1f}, {0, 1, 0, 1}}));
}

TEST(GltfMorph, targetsAndWeightsAreKept) {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    const int target = builder.positions({0, 0, 1, 0, 0, 2, 0, 0, 3});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", target}}}}}});
    builder.json["meshes"][0]["weights"] = {0.25};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.meshes[0].morphTargets.size(), 1u);
    EXPECT_EQ(scene.meshes[0].morphTargets[0].positions, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}));
    EXPECT_EQ(scene.meshes[0].morphWeights, (std::vector<float>{0.25f}));
    EXPECT_TRUE(scene.ignored.empty());
}

TEST(GltfMaterial, factorsAndModes) {
    GltfBuilder builder;
    builder.json["materials"] = {
        nlohmann::json::object(),
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
         {"emissiveFactor", {0.5, 0, 1}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_unlit", nlohmann::json::object()},
           {"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.materials.at(0).baseColorFactor, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallicFactor, 1.0f);
    const Material& material = scene.materials.at(1);
    EXPECT_EQ(material.baseColorFactor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.metallicFactor, 0.0f);
    EXPECT_EQ(material.roughnessFactor, 0.5f);
    EXPECT_EQ(material.emissiveFactor, glm::vec3(4, 0, 8));
    EXPECT_EQ(material.alphaMode, AlphaMode::mask);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_TRUE(material.unlit);
}

TEST(GltfMaterial, emissionThatOverflowsSumsIsLimited) {
    GltfBuilder builder;
    builder.json["materials"] = {{{"name", "Sun"},
                                  {"emissiveFactor", {1, 0, 0.5}},
                                  {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e38}}}}}}};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.materials.at(0).emissiveFactor, glm::vec3(1e30f, 0, 1e30f));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what, "emission of material 0 'Sun'");
}

TEST(GltfMaterial, layersOfTheExtensions) {
    GltfBuilder builder;
    const auto material = [](const nlohmann::json& extensions) -> nlohmann::json {
        return {{"extensions", extensions}};
    };
    builder.json["extensionsRequired"] = {"KHR_materials_clearcoat",    "KHR_materials_ior",
                                          "KHR_materials_sheen",        "KHR_materials_specular",
                                          "KHR_materials_transmission", "KHR_materials_volume"};
    builder.json["materials"] = {
        material({{"KHR_materials_ior", {{"ior", 1.33}}},
                  {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {2, 0.5, 0.25}}}}}),
        material({{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                  {"KHR_materials_volume",
                   {{"thicknessFactor", 2}, {"attenuationDistance", 3}, {"attenuationColor", {1, 0.5, 0.25}}}}}),
        material({{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}},
                  {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 1}}, {"sheenRoughnessFactor", 0.75}}}}),
        material({{"KHR_materials_ior", {{"ior", 0}}}, {"KHR_materials_volume", {{"thicknessFactor", 1}}}}),
        material({{"KHR_materials_transmission", nlohmann::json::object()},
                  {"KHR_materials_clearcoat", nlohmann::json::object()},
                  {"KHR_materials_sheen", nlohmann::json::object()},
                  {"KHR_materials_specular", nlohmann::json::object()},
                  {"KHR_materials_ior", nlohmann::json::object()}})};
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    const std::vector<Material>& m = scene.materials;
    EXPECT_EQ(m.at(0).ior, 1.33f);
    EXPECT_EQ(m[0].specularFactor, 0.5f);
    EXPECT_EQ(m[0].specularColorFactor, glm::vec3(2, 0.5f, 0.25f)) << "may be above 1";
    EXPECT_TRUE(m[0].hasOwnReflectance());
    EXPECT_EQ(m.at(1).transmissionFactor, 0.75f);
    EXPECT_EQ(m[1].thicknessFactor, 2.0f);
    EXPECT_EQ(m[1].attenuationDistance, 3.0f);
    EXPECT_EQ(m[1].attenuationColor, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(m.at(2).clearcoatFactor, 0.5f);
    EXPECT_EQ(m[2].clearcoatRoughnessFactor, 0.25f);
    EXPECT_EQ(m[2].sheenColorFactor, glm::vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(m[2].sheenRoughnessFactor, 0.75f);
    EXPECT_EQ(m.at(3).ior, 0.0f);
    EXPECT_FALSE(m[3].transmits()) << "a volume without transmission";
    const Material& plain = m.at(4);
    EXPECT_FALSE(plain.transmits() || plain.hasClearcoat() || plain.hasSheen() || plain.hasOwnReflectance());
}

TEST(GltfMaterial, filmsStretchedHighlightsAndLightFromBehind) {
    GltfBuilder builder;
    builder.json["extensionsRequired"] = {"KHR_materials_anisotropy", "KHR_materials_iridescence",
                                          "KHR_materials_dispersion", "KHR_materials_diffuse_transmission"};
    builder.json["materials"] = {
        {{"extensions",
          {{"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.25}}},
           {"KHR_materials_iridescence",
            {{"iridescenceFactor", 0.75},
             {"iridescenceIor", 1.5},
             {"iridescenceThicknessMinimum", 200},
             {"iridescenceThicknessMaximum", 300}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
           {"KHR_materials_volume", {{"thicknessFactor", 1}}},
           {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
           {"KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.25}, {"diffuseTransmissionColorFactor", {1, 0.5, 0}}}}}}},
        {{"extensions",
          {{"KHR_materials_anisotropy", nlohmann::json::object()},
           {"KHR_materials_iridescence", nlohmann::json::object()},
           {"KHR_materials_dispersion", nlohmann::json::object()},
           {"KHR_materials_diffuse_transmission", nlohmann::json::object()}}}}};
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.anisotropyStrength, 0.5f);
    EXPECT_EQ(m.anisotropyRotation, 1.25f);
    EXPECT_EQ(m.iridescenceFactor, 0.75f);
    EXPECT_EQ(m.iridescenceIor, 1.5f);
    EXPECT_EQ(m.iridescenceThicknessMinimum, 200.0f);
    EXPECT_EQ(m.iridescenceThicknessMaximum, 300.0f);
    EXPECT_TRUE(m.isDispersive());
    EXPECT_EQ(m.diffuseTransmissionFactor, 0.25f);
    EXPECT_EQ(m.diffuseTransmissionColorFactor, glm::vec3(1, 0.5f, 0));
    const Material& plain = scene.materials.at(1);
    EXPECT_FALSE(plain.isAnisotropic() || plain.isIridescent() || plain.isDispersive() || plain.transmitsDiffusely());
}

// For grey diffuse and specular colours d and s, a metallic-roughness material with the same reflection exists: s =
// 0.04·(1 − m) + b·m and d·(1 − s) = (1 − 0.04)·b·(1 − m), with base colour b and metalness m.
TEST(GltfMaterial, specularGlossinessKeepsBothReflections) {
    for (const double diffuse : {0.0, 0.1, 0.5, 0.8})
        for (const double specular : {0.04, 0.1, 0.5, 0.9}) {
            GltfBuilder builder;
            builder.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
            builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}},
                                          {"extensions",
                                           {{"KHR_materials_pbrSpecularGlossiness",
                                             {{"diffuseFactor", {diffuse, diffuse, diffuse, 0.5}},
                                              {"specularFactor", {specular, specular, specular}},
                                              {"glossinessFactor", 0.75}}}}}}};
            const Scene scene = builder.load();
            const Material& material = scene.materials.at(0);
            const double base = material.baseColorFactor.g;
            const double metalness = material.metallicFactor;
            EXPECT_NEAR(0.04 * (1 - metalness) + base * metalness, specular, 2e-6) << diffuse << ' ' << specular;
            EXPECT_NEAR(0.96 * base * (1 - metalness), diffuse * (1 - specular), 2e-6) << diffuse << ' ' << specular;
            EXPECT_EQ(material.baseColorFactor.a, 0.5f);
            EXPECT_EQ(material.roughnessFactor, 0.25f);
            EXPECT_TRUE(scene.ignored.empty());
        }
}

// Conversion from specular-glossiness keeps the colours of dielectrics and of metals.
TEST(GltfMaterial, specularGlossinessKeepsColours) {
    const auto materialOf = [](const nlohmann::json& extension) {
        GltfBuilder builder;
        builder.json["materials"] = {{{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}}};
        return builder.load().materials.at(0);
    };
    const Material leaf = materialOf({{"diffuseFactor", {0.1, 0.6, 0.2, 1}}, {"specularFactor", {0.04, 0.04, 0.04}}});
    EXPECT_LT(glm::distance(leaf.baseColorFactor, glm::vec4(0.1f, 0.6f, 0.2f, 1)), 1e-5f);
    EXPECT_EQ(leaf.metallicFactor, 0.0f);
    EXPECT_EQ(leaf.roughnessFactor, 0.0f) << "the standard's glossiness is 1";
    const Material gold = materialOf({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1, 0.77, 0.34}}});
    EXPECT_LT(glm::distance(gold.baseColorFactor, glm::vec4(1, 0.77f, 0.34f, 1)), 1e-5f);
    EXPECT_NEAR(gold.metallicFactor, 1, 1e-6);
}

// Returns two triangles. The first has materials for variants Day and Night, the second only for Night.
GltfBuilder dayAndNight() {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    const auto mapping = [](std::vector<int> variants, int material) {
        return nlohmann::json{{"variants", std::move(variants)}, {"material", material}};
    };
    const auto primitive = [&](const nlohmann::json& mappings) {
        return nlohmann::json{{"attributes", {{"POSITION", positions}}},
                              {"material", 0},
                              {"extensions", {{"KHR_materials_variants", {{"mappings", mappings}}}}}};
    };
    builder.mesh({primitive({mapping({0}, 1), mapping({1}, 2)}), primitive(nlohmann::json::array({mapping({1}, 1)}))});
    builder.json["extensionsUsed"] = {"KHR_materials_variants"};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Day"}}, {{"name", "Night"}}};
    builder.json["materials"] = {{{"name", "plain"}}, {{"name", "first"}}, {{"name", "second"}}};
    return builder;
}

TEST(GltfVariant, givesPrimitivesItsMaterials) {
    const ScratchFolder folder;
    GltfBuilder::save(folder / "a.glb", dayAndNight().glb());
    const auto materialsOf = [&](const std::string& variant) {
        const Scene scene = loadGltf(folder / "a.glb", {}, variant);
        EXPECT_TRUE(scene.ignored.empty());
        EXPECT_EQ(scene.variants, (std::vector<std::string>{"Day", "Night"}));
        EXPECT_EQ(scene.variant, variant);
        std::vector<int> materials;
        for (const Primitive& primitive : scene.meshes.at(0).primitives) materials.push_back(primitive.material);
        return materials;
    };
    EXPECT_EQ(materialsOf(""), (std::vector<int>{0, 0}));
    EXPECT_EQ(materialsOf("Day"), (std::vector<int>{1, 0}));
    EXPECT_EQ(materialsOf("Night"), (std::vector<int>{2, 1}));
}

TEST(GltfVariant, thatDoesNotExistIsRefusedWithTheListOfAll) {
    const ScratchFolder folder;
    GltfBuilder::save(folder / "a.glb", dayAndNight().glb());
    try {
        static_cast<void>(loadGltf(folder / "a.glb", {}, "Dusk"));
        FAIL();
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("there is no variant 'Dusk'; the file has: Day, Night"), std::string::npos) << text;
    }
}

TEST(GltfScene, theDefaultSceneIsTakenWithItsNodesOnly) {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    builder.mesh({{{"attributes", {{"POSITION", positions}}}}}, {{"name", "first"}});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}}}, {{"name", "second"}});
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}, {"name", "chosen"}}};
    builder.json["scene"] = 1;
    const Scene scene = builder.load();
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].name, "second");
    EXPECT_EQ(scene.name, "chosen");
    EXPECT_EQ(scene.ignored.at(0).what, "scene");

    builder.json.erase("scene");
    EXPECT_EQ(builder.load().nodes.at(0).name, "first");
    builder.json.erase("scenes");
    EXPECT_EQ(builder.load().nodes.size(), 2u);
}

TEST(GltfScene, cameraExtrasAreLensValues) {
    GltfBuilder builder;
    builder.json["cameras"] = {
        {{"type", "perspective"},
         {"name", "shot"},
         {"perspective", {{"yfov", 0.5}, {"znear", 0.2}, {"aspectRatio", 1.5}}},
         {"extras", {{"fStop", 1.4}, {"focusDistance", 2.5}, {"horizontalAperture", -1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}}};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.cameras.at(0).lensValue("fStop"), 1.4);
    EXPECT_EQ(scene.cameras[0].lensValue("focusDistance"), 2.5);
    EXPECT_EQ(scene.cameras[0].lensValue("horizontalAperture"), -1) << "the loader does not check lens values";
    EXPECT_EQ(scene.cameras[0].yfov, 0.5);
    EXPECT_TRUE(scene.cameras.at(1).orthographic);
}

nlohmann::json physicalCamera(const nlohmann::json& extension) {
    return {{"type", "perspective"},
            {"perspective", {{"yfov", 0.66059}, {"znear", 0.01}, {"aspectRatio", 1.5}}},
            {"extensions", {{"EXT_camera_physical", extension}}}};
}

// Values of EXT_camera_physical are in metres, and extras override them. The values are from the example in the
// extension's draft.
TEST(GltfScene, physicalCamerasAreInMetresAndExtrasWin) {
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"EXT_camera_physical"};
    builder.json["cameras"] = {
        physicalCamera(
            {{"focalLength", 0.035}, {"sensorSize", {0.036, 0.024}}, {"fStop", 2.8}, {"focusDistance", 5.0}}),
        physicalCamera({{"focalLength", 0.05}, {"sensorSize", {0.024, 0.016}}, {"fStop", 8}})};
    builder.json["cameras"][1]["extras"] = {{"fStop", 1.4}};
    const Scene scene = builder.load();
    ASSERT_TRUE(scene.cameras.at(0).physical);
    EXPECT_DOUBLE_EQ(scene.cameras[0].physical->focalLength, 35);
    EXPECT_DOUBLE_EQ(scene.cameras[0].physical->sensorSize.x, 36);
    EXPECT_DOUBLE_EQ(scene.cameras[0].physical->sensorSize.y, 24);
    EXPECT_EQ(scene.cameras[0].lensValue("fStop"), 2.8);
    EXPECT_EQ(scene.cameras[0].lensValue("focusDistance"), 5);
    EXPECT_EQ(scene.cameras.at(1).lensValue("fStop"), 1.4);
    EXPECT_FALSE(scene.cameras[1].lensValue("focusDistance"));
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_EQ(scene.extensions, std::vector<std::string>{"EXT_camera_physical"});
}

TEST(GltfScene, impossiblePhysicalCamerasAreFaults) {
    const auto fault = [](const nlohmann::json& extension) -> std::string {
        GltfBuilder builder;
        builder.json["cameras"] = {physicalCamera(extension)};
        try {
            (void)builder.load();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(fault({{"focalLength", 0}, {"sensorSize", {0.036, 0.024}}}).find("invalid focalLength: 0"),
              std::string::npos);
    EXPECT_NE(fault({{"focalLength", 0.05}, {"sensorSize", {0.036, -1}}}).find("invalid sensorSize: -1"),
              std::string::npos);
    EXPECT_NE(fault({{"focalLength", 0.05}, {"sensorSize", {0.036}}}).find("must have 2 numbers, not 1"),
              std::string::npos);
    EXPECT_NE(fault({{"focalLength", 0.05}}).find("sensorSize is missing"), std::string::npos);
    EXPECT_NE(fault({{"focalLength", "50 mm"}, {"sensorSize", {0.036, 0.024}}}).find("must be a number"),
              std::string::npos);
    EXPECT_NE(fault({{"focalLength", 0.05}, {"sensorSize", {0.036, 0.024}}, {"fStop", 0}}).find("invalid fStop"),
              std::string::npos);
    EXPECT_EQ(fault({{"focalLength", 0.05}, {"sensorSize", {0.036, 0.024}}}), "");
}

// Values of EXT_camera_physical in millimetres come from exporters that misread the draft's unit. The loader ignores
// these values and states the reason.
TEST(GltfScene, physicalCamerasInMillimetresAreIgnoredWithAReason) {
    GltfBuilder builder;
    builder.json["cameras"] = {physicalCamera({{"focalLength", 35}, {"sensorSize", {36, 24}}})};
    const Scene scene = builder.load();
    EXPECT_FALSE(scene.cameras.at(0).physical);
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_NE(scene.ignored[0].reason.find("millimetres"), std::string::npos);
}

// Extras of a camera's node are also lens values: Blender exports custom properties of the camera's data as extras of
// the camera, and custom properties of the camera object as extras of the node.
TEST(GltfScene, customPropertiesOfACamerasNodeAreLensValuesToo) {
    GltfBuilder builder;
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.2}}}, {"extras", {{"fStop", 1.4}}}}};
    builder.json["nodes"] = {
        {{"camera", 0}, {"extras", {{"fStop", 8}, {"focusDistance", 3}, {"dofEnabled", true}, {"note", "x"}}}}};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.cameras.at(0).lensValue("fStop"), 1.4) << "the camera's own values take precedence";
    EXPECT_EQ(scene.cameras[0].lensValue("focusDistance"), 3);
    EXPECT_EQ(scene.cameras[0].lensValue("dofEnabled"), 1);
}

// Blade rotation in a file from Blender is converted. At the same rotation angle, Cycles' aperture polygon has the
// midpoint of an edge where this project's polygon has a corner. The difference is half the angle between two corners.
TEST(GltfScene, bladesOfAFileFromBlenderStandAsInBlender) {
    GltfBuilder builder;
    const auto camera = [](const nlohmann::json& extras) -> nlohmann::json {
        return {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.2}}}, {"extras", extras}};
    };
    builder.json["cameras"] = {camera({{"bladeCount", 6}, {"bladeRotation", 15}}), camera({{"bladeCount", 5}}),
                               camera({{"bladeRotation", 15}})};
    const auto rotation = [](const Scene& scene, std::size_t i) {
        return scene.cameras.at(i).lensValue("bladeRotation").value_or(0);
    };
    Scene scene = builder.load();
    EXPECT_EQ(rotation(scene, 0), 15);
    EXPECT_EQ(rotation(scene, 1), 0);
    builder.json["asset"]["generator"] = "Khronos glTF Blender I/O v4.2.60";
    scene = builder.load();
    EXPECT_EQ(rotation(scene, 0), 15 + 30);
    EXPECT_EQ(rotation(scene, 1), 36);
    EXPECT_EQ(rotation(scene, 2), 15) << "no rotation without a blade count";
}

// Returns a file with a triangle that has the vertex attribute _COC_SCALE, on a node with cocScale in its extras.
GltfBuilder scaledBlur(const std::vector<float>& scales, const nlohmann::json& nodeScale) {
    GltfBuilder builder;
    const int positions = builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    builder.mesh({{{"attributes", {{"POSITION", positions}, {"_COC_SCALE", builder.floats(scales, "SCALAR", 1)}}}}},
                 {{"extras", {{"cocScale", nodeScale}}}});
    return builder;
}

TEST(GltfMesh, scalesOfTheBlurAreThoseOfTheFile) {
    const Scene scene = scaledBlur({0, 0.5f, 2}, 0.25).load();
    EXPECT_EQ(scene.meshes.at(0).vertices.blurs, (std::vector<VertexBlur>{{0, 0, 0}, {0.5f, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(scene.meshes[0].blurBounds, (VertexBlurBounds{0, 2, 0, 0, false}));
    EXPECT_EQ(scene.nodes.at(0).cocScale, 0.25);
}

TEST(GltfMesh, scalesOfTheBlurThatAreNoneAreFaults) {
    const auto fault = [](const std::vector<float>& scales, const nlohmann::json& nodeScale) -> std::string {
        try {
            (void)scaledBlur(scales, nodeScale).load();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(fault({1, std::nanf(""), 1}, 1).find("_COC_SCALE of vertex 1 is nan"), std::string::npos);
    EXPECT_NE(fault({1, 1, -2}, 1).find("_COC_SCALE of vertex 2 is -2"), std::string::npos);
    EXPECT_NE(fault({1, 1, 1}, -1).find("cocScale must be a number of at least 0"), std::string::npos);
    EXPECT_NE(fault({1, 1, 1}, "none").find("cocScale must be a number of at least 0"), std::string::npos);
}

// Returns a file with a triangle that has additional vertex attributes, one number per vertex.
GltfBuilder ownBlurs(const std::vector<std::pair<std::string, std::vector<float>>>& attributes) {
    GltfBuilder builder;
    nlohmann::json all = {{"POSITION", builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}};
    for (const auto& [name, values] : attributes) all[name] = builder.floats(values, "SCALAR", 1);
    builder.mesh({{{"attributes", all}}});
    return builder;
}

TEST(GltfMesh, blursOfVerticesReplaceAddAndChange) {
    const auto blurs = [](const std::vector<std::pair<std::string, std::vector<float>>>& attributes) {
        return ownBlurs(attributes).load().meshes.at(0).vertices.blurs;
    };
    using Blurs = std::vector<VertexBlur>;
    EXPECT_EQ(blurs({{"_COC", {0, -1, 2}}}), (Blurs{{0, 0, 0}, {0, -1, -1}, {0, 2, 2}}));
    EXPECT_EQ(blurs({{"_COC_OFFSET", {0, -1, 2}}}), (Blurs{{1, 0, 0}, {1, -1, -1}, {1, 2, 2}}));
    EXPECT_EQ(blurs({{"_COC_0", {0, -1, 2}}, {"_COC_1", {1, 1, 1}}}), (Blurs{{0, 0, 1}, {0, -1, 1}, {0, 2, 1}}));
    EXPECT_EQ(blurs({{"_COC", {1, 2, 3}}, {"_COC_SCALE", {0, 1, 2}}, {"_COC_OFFSET", {5, 6, 7}}}),
              (Blurs{{0, 5, 5}, {0, 8, 8}, {0, 13, 13}}));
    EXPECT_EQ(blurs({}), Blurs{});
    const Scene pair = ownBlurs({{"_COC_0", {0, -1, 2}}, {"_COC_1", {1, 1, 1}}}).load();
    EXPECT_EQ(pair.meshes[0].blurBounds, (VertexBlurBounds{0, 0, -1, 2, true}));
}

TEST(GltfMesh, blursOfVerticesThatAreNoneAreFaults) {
    const auto fault = [](const std::vector<std::pair<std::string, std::vector<float>>>& attributes) -> std::string {
        try {
            (void)ownBlurs(attributes).load();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(fault({{"_COC", {1, 2, INFINITY}}}).find("_COC of vertex 2 is inf; it must be from"), std::string::npos);
    EXPECT_NE(fault({{"_COC_OFFSET", {std::nanf(""), 2, 0}}}).find("_COC_OFFSET of vertex 0 is nan"),
              std::string::npos);
    EXPECT_NE(fault({{"_COC_0", {1, 2, 3}}}).find("_COC_0 and _COC_1 must be given together"), std::string::npos);
    EXPECT_NE(fault({{"_COC_0", {1, 2, 3}}, {"_COC_1", {1, 2, 3}}, {"_COC", {1, 2, 3}}})
                  .find("cannot be combined with _COC_0"),
              std::string::npos);
}

TEST(GltfScene, lightsShineAlongTheirNodesMinusZ) {
    GltfBuilder builder;
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"},
                                                                    {"color", {1, 0.5, 0}},
                                                                    {"intensity", 20},
                                                                    {"range", 7},
                                                                    {"spot", {{"outerConeAngle", 0.6}}}}};
    const double half = std::sqrt(0.5);
    builder.json["nodes"] = {{{"rotation", {0, half, 0, half}},  // a quarter turn about y: −z becomes −x
                              {"translation", {1, 2, 3}},
                              {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    const Scene scene = builder.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.lights.size(), 1u);
    EXPECT_LT(glm::length(pose.lights[0].direction - glm::dvec3(-1, 0, 0)), 1e-12);
    EXPECT_EQ(pose.lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(pose.lights[0].light.type, LightType::spot);
    EXPECT_FLOAT_EQ(pose.lights[0].light.outerConeAngle, 0.6f);
    EXPECT_EQ(pose.lights[0].light.range, 7.0f);
}

TEST(GltfScene, instancesCombineTranslationRotationAndScale) {
    GltfBuilder builder;
    const int positions = builder.positions(unitTriangle);
    const int translation = builder.positions({1, 0, 0, 0, 0, 5});
    // Rotations: a quarter turn about z as normalised shorts, and the identity.
    const int rotation = builder.accessor(builder.view(std::vector<std::int16_t>{0, 0, 23170, 23170, 0, 0, 0, 32767}),
                                          gltfShort, "VEC4", 2, {{"normalized", true}});
    const int scale = builder.positions({2, 2, 2, 1, 1, 1});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}}},
                 {{"translation", {0, 10, 0}},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes", {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}}}}}}}});
    const Pose pose = poseAt(builder.load(), 0);
    ASSERT_EQ(pose.objects.size(), 2u);
    // (1, 0, 0) is scaled by 2, rotated to (0, 2, 0), moved to (1, 2, 0), and moved by the node to (1, 12, 0).
    EXPECT_LT(glm::length(glm::dvec3(pose.objects[0].worldFromObject * glm::dvec4(1, 0, 0, 1)) - glm::dvec3(1, 12, 0)),
              1e-4);
    EXPECT_LT(glm::length(glm::dvec3(pose.objects[1].worldFromObject * glm::dvec4(1, 0, 0, 1)) - glm::dvec3(1, 10, 5)),
              1e-4);
}

TEST(GltfFiles, dataUrisSpacesAndCodedNames) {
    const ScratchFolder folder;
    const std::vector<float> values = unitTriangle;
    const std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    nlohmann::json json = {
        {"asset", {{"version", "2.0"}}},
        {"buffers", {{{"byteLength", 36}, {"uri", ""}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
        {"accessors", {{{"bufferView", 0}, {"componentType", gltfFloat}, {"count", 3}, {"type", "VEC3"}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
        {"nodes", {{{"mesh", 0}}}},
    };
    const auto trianglesWith = [&](const std::string& uri) {
        json["buffers"][0]["uri"] = uri;
        GltfBuilder::save(folder / "a file.gltf", json.dump());
        return loadGltf(folder / "a file.gltf").meshes.at(0).bounds().maximum;
    };
    const glm::dvec3 expected(1, 1, 0);
    GltfBuilder::save(folder / "with space é.bin", bytes);
    GltfBuilder::save(folder / "100%25.bin", bytes);
    EXPECT_EQ(trianglesWith("with space é.bin"), expected);
    EXPECT_EQ(trianglesWith("with%20space%20%C3%A9.bin"), expected);
    EXPECT_EQ(trianglesWith("100%25.bin"), expected) << "a name that only looks percent-encoded";
    const std::string zeros(32, 'A');  // base64 of 24 zero bytes
    EXPECT_EQ(trianglesWith("data:application/octet-stream;base64,AACAPwAAgD8AAAAA" + zeros), expected);
    EXPECT_EQ(trianglesWith("data:text/any;base64,AACAPwAAgD8AAAAA" + zeros + "AAAA"), expected) << "longer data";
    EXPECT_EQ(trianglesWith("DATA:text/any;BASE64,AACAPwAA\r\n gD8AAAAA\n" + zeros + "\n"), expected) << "line breaks";
    EXPECT_EQ(trianglesWith("data:text/any;base64,AACAPwAAgD8%0AAAAA" + zeros + "AA==\n"), expected)
        << "encoded breaks";
    EXPECT_EQ(trianglesWith("data:text/any;base64,AACAPwAAgD8AAAAA" + zeros + "AA"), expected) << "no padding";
    EXPECT_THROW(trianglesWith("data:text/any;base64,AACAPwAA*D8AAAAA" + zeros), Error);
    GltfBuilder::save(folder / "a+b c.bin", bytes);
    EXPECT_EQ(trianglesWith("a+b%20c.bin"), expected) << "a plus sign is not a space";
}

}  // namespace
}  // namespace defocus::engine
