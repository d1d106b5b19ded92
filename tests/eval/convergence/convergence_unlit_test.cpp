#include <gtest/gtest.h>

#include "eval/convergence/unlit_scene.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Lighting is baked into the vertex colours of an unlit scene. A quad that faces +z, under a light from (0.4, 0.8,
// 0.6)/√1.16, reflects 0.2 (ambient) + 0.8 (diffuse) · 0.6/√1.16 (cosine) of its colour.
TEST(ConvergenceUnlit, paintsTheLightOnTheVertices) {
    Scene scene;
    const Material lit{.baseColorFactor = {0.5f, 0.25f, 1, 0.5f}, .alphaMode = AlphaMode::blend};
    scene.materials.push_back(lit);
    scene.meshes = {quad(0), quad(-1)};
    scene.meshes[0].vertices.normals.clear();
    const Scene unlit = unlitScene(scene);
    for (const Mesh& mesh : unlit.meshes) {
        ASSERT_EQ(mesh.vertices.colors.size(), 4u);
        EXPECT_FLOAT_EQ(mesh.vertices.colors[2].r, static_cast<float>(0.2 + 0.8 * 0.6 / std::sqrt(1.16)));
        const Material& material = unlit.materials.at(static_cast<std::size_t>(mesh.primitives[0].material));
        EXPECT_TRUE(material.unlit);
        EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
    }
    EXPECT_EQ(unlit.materials[0].baseColorFactor, glm::vec4(0.5f, 0.25f, 1, 1));
}

TEST(ConvergenceUnlit, texturesBecomeTheirMeanColour) {
    Scene scene;
    scene.images.push_back({2, 1, {255, 0, 0, 255, 0, 255, 0, 255}});
    scene.imageNames = {"halves"};
    Texture texture;
    texture.image = 0;
    scene.textures.push_back(texture);
    Material textured;
    textured.baseColor.texture = 0;
    textured.baseColorFactor = {1, 0.5f, 1, 1};
    scene.materials.push_back(textured);
    scene.meshes.push_back(quad(0));
    const Scene unlit = unlitScene(scene);
    EXPECT_EQ(unlit.materials[0].baseColorFactor, glm::vec4(0.5f, 0.25f, 0, 1));
    EXPECT_FALSE(unlit.materials[0].baseColor.used());
    EXPECT_TRUE(unlit.images.empty());
}

}  // namespace
}  // namespace defocus::engine
