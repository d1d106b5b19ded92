// Tests that levels of the project's own models look like level 0 under a wide blur (conserved_levels.h).

#include <gtest/gtest.h>

#include <numbers>

#include "lod/conserved_levels.h"
#include "lod/shapes.h"
#include "models.h"
#include "scene/gltf/gltf.h"

namespace defocus::engine {
namespace {

TEST(Conserved, ofASphereIsKnown) {
    Mesh mesh = sphere(192, 96);
    mesh.vertices.colors.assign(mesh.vertices.count(), {0.25f, 0.5f, 0.75f, 1});
    const Pyramid pyramid = fullDetail(mesh);
    const Conserved measured = conservedBy(pyramid, 0, vertexColours(pyramid, 0), 10'000, 1024);
    EXPECT_NEAR(measured.area, 4 * std::numbers::pi, 0.01);
    EXPECT_LT(glm::distance(measured.colour, glm::dvec3(0.25, 0.5, 0.75)), 1e-6);
    for (const double light : measured.light) EXPECT_NEAR(light, 0.5 / 4, 1e-3);
    for (const double outline : measured.outline) EXPECT_NEAR(outline, std::numbers::pi, 0.01);
}

TEST(Conserved, ofAGreyHalfIsTheMean) {
    Mesh mesh = flatGrid(8);
    for (const glm::vec3& p : mesh.vertices.positions)
        mesh.vertices.colors.emplace_back(glm::vec3(p.x < 0.51f ? 0 : 1), 1);
    const Pyramid pyramid = fullDetail(mesh);
    const Conserved measured = conservedBy(pyramid, 0, vertexColours(pyramid, 0), 100, 64);
    EXPECT_NEAR(measured.colour.x, 7.0 / 16, 1e-6);
}

TEST(Conserved, levelsOfAFishKeepColourLightAndOutline) {
    const Scene scene = loadGltf(modelPath("meshes/fish.glb"));
    expectConserved(scene.meshes.front(), {});
}

TEST(Conserved, levelsOfABumpySphereKeepThem) {
    Mesh mesh = sphere(96, 48, 0.03);
    for (const glm::vec3& p : mesh.vertices.positions)
        mesh.vertices.colors.emplace_back(p.x > 0.3f ? 1.0f : 0.0f, 0.5f + 0.5f * p.y, 0.2f, 1.0f);
    expectConserved(mesh, {});
}

}  // namespace
}  // namespace defocus::engine
