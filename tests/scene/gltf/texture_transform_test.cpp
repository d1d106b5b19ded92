// Tests KHR_texture_transform, which scales texture coordinates, rotates them counter-clockwise (v points down), and
// translates them.

#include <gtest/gtest.h>

#include <cmath>

#include "image/png_builder.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

Scene transformed(const nlohmann::json& transform) {
    GltfBuilder builder;
    const int corners = builder.positions(unitTriangle);
    const int coordinates = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    builder.mesh({{{"attributes", {{"POSITION", corners}, {"TEXCOORD_0", coordinates}, {"TEXCOORD_1", coordinates}}},
                   {"material", 0}}});
    const Bytes png = buildPng(1, 1, 8, PngColour::grey, {255});
    builder.add("images", {{"mimeType", "image/png"}, {"bufferView", builder.view(png)}});
    builder.add("textures", {{"source", 0}});
    builder.json["extensionsUsed"] = nlohmann::json::array({"KHR_texture_transform"});
    builder.add("materials",
                {{"pbrMetallicRoughness",
                  {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}},
                   {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    return builder.load();
}

void expectPlaced(const nlohmann::json& transform, const glm::dvec2& from, const glm::dvec2& to) {
    const Scene scene = transformed(transform);
    const glm::vec3 placed = scene.materials.at(0).baseColor.uvTransform * glm::vec3(glm::vec2(from), 1);
    EXPECT_NEAR(placed.x, to.x, 1e-6) << transform;
    EXPECT_NEAR(placed.y, to.y, 1e-6) << transform;
}

TEST(GltfTextureTransform, movesTurnsAndScales) {
    expectPlaced({{"offset", {0.25, -0.5}}}, {0.5, 0.5}, {0.75, 0});
    expectPlaced({{"scale", {2, 3}}}, {0.5, 0.5}, {1, 1.5});
    // a quarter turn, which moves the right edge to the top
    expectPlaced({{"rotation", std::acos(0.0)}}, {1, 0}, {0, -1});
    expectPlaced({{"rotation", std::acos(0.0)}}, {0, 1}, {1, 0});
    const double angle = 0.4;
    expectPlaced({{"offset", {0.1, 0.2}}, {"rotation", angle}, {"scale", {2, 3}}}, {1, 1},
                 {0.1 + 2 * std::cos(angle) + 3 * std::sin(angle), 0.2 - 2 * std::sin(angle) + 3 * std::cos(angle)});
}

TEST(GltfTextureTransform, belongsToItsTextureAndMayChooseTheSet) {
    const Scene scene = transformed({{"offset", {0.25, 0}}, {"texCoord", 1}});
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.baseColor.uvSet, 1);
    EXPECT_EQ(material.metallicRoughness.uvSet, 1);
    EXPECT_EQ(material.metallicRoughness.uvTransform, glm::mat3(1));
    EXPECT_EQ(transformed({{"offset", {0.25, 0}}}).materials.at(0).baseColor.uvSet, 0);
}

}  // namespace
}  // namespace defocus::engine
