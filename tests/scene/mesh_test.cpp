// Tests vertex normals and tangents of meshes.

#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models.h"
#include "scene/gltf/gltf.h"
#include "scene/tangents.h"

namespace defocus::engine {
namespace {

TEST(Mesh, boundsAreOfWhatTrianglesUse) {
    Mesh mesh;
    EXPECT_TRUE(mesh.bounds().empty());
    mesh.vertices.positions = {{9, 9, 9}, {1, 2, 3}, {-1, 0, 0}, {0, 5, 0}};
    mesh.primitives = {{-1, {1, 2, 3}}, {0, {3, 2, 1}}};
    EXPECT_EQ(mesh.bounds().minimum, glm::dvec3(-1, 0, 0));
    EXPECT_EQ(mesh.bounds().maximum, glm::dvec3(1, 5, 3));
    EXPECT_EQ(mesh.triangleCount(), 2u);
}

TEST(SmoothNormals, weighByAreaAcrossEqualPositions) {
    // Two triangles at a right angle share the edge from (0,0,0) to (0,0,1). Each triangle has its own vertices on the
    // edge, and one of these vertices has a coordinate of −0. One triangle of area 1 faces y; the other, of area 2,
    // faces x.
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {-0.0f, 0, 0}, {0, 4, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5};
    const std::vector<glm::vec3> normals = smoothNormals(positions, indices);
    const glm::vec3 shared = glm::normalize(glm::vec3(2, 1, 0));
    for (const std::size_t i : {0, 1, 3, 5}) EXPECT_NEAR(glm::dot(normals[i], shared), 1, 1e-6) << i;
    EXPECT_EQ(normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(normals[4], glm::vec3(1, 0, 0));
}

TEST(SmoothNormals, vertexWithoutProperTriangleFacesUp) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {7, 7, 7}};
    for (const glm::vec3& normal : smoothNormals(positions, {0, 1, 2})) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

// Returns a square in the plane z = 0 with an upright texture: u points right, and v (down in glTF) starts at the top.
VertexBlock uprightSquare() {
    VertexBlock block;
    block.vertices.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    block.vertices.normals.assign(4, {0, 0, 1});
    block.vertices.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    return block;
}

TEST(Tangents, pointAlongUWithTheBitangentUp) {
    std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    std::vector<std::uint32_t>* lists[] = {&indices};
    const VertexBlock result = withTangents(uprightSquare(), lists, 0);
    EXPECT_EQ(result.vertices.count(), 4u);
    for (const glm::vec4& tangent : result.vertices.tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, mirroredTriangleGetsVerticesOfItsOwn) {
    VertexBlock block = uprightSquare();
    block.vertices.uv0[3] = {1, 1};  // the second triangle's mapping is now mirrored
    std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    std::vector<std::uint32_t>* lists[] = {&indices};
    const VertexBlock result = withTangents(block, lists, 0);
    ASSERT_EQ(result.vertices.count(), 6u);
    for (std::size_t corner = 0; corner < 6; ++corner)
        EXPECT_EQ(result.vertices.tangents[indices[corner]].w, corner < 3 ? 1.0f : -1.0f);
}

TEST(Tangents, withoutTextureCoordinatesAreStillPerpendicular) {
    VertexBlock block = uprightSquare();
    block.vertices.uv0.clear();
    std::vector<std::uint32_t> indices = {0, 1, 2};
    std::vector<std::uint32_t>* lists[] = {&indices};
    for (const glm::vec4& tangent : withTangents(block, lists, 0).vertices.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, 1e-6);
        EXPECT_NEAR(tangent.z, 0, 1e-6);
    }
}

// The tangents of a torus follow ∂p/∂u, which is known: u runs around the axis of the torus, and v runs around the
// tube.
TEST(Tangents, ofATorusFollowItsFirstCoordinate) {
    constexpr int around = 64, ring = 32;
    VertexBlock block;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec3> along;
    for (int j = 0; j <= ring; ++j)
        for (int i = 0; i <= around; ++i) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / ring;
            const glm::dvec3 out(std::sin(u), 0, std::cos(u));
            block.vertices.positions.emplace_back(out * (1 + 0.3 * std::cos(v)) + glm::dvec3(0, 0.3 * std::sin(v), 0));
            block.vertices.normals.emplace_back(out * std::cos(v) + glm::dvec3(0, std::sin(v), 0));
            block.vertices.uv0.emplace_back(static_cast<double>(i) / around, 1 - static_cast<double>(j) / ring);
            along.emplace_back(std::cos(u), 0, -std::sin(u));
        }
    const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * (around + 1) + i); };
    for (int j = 0; j < ring; ++j)
        for (int i = 0; i < around; ++i)
            indices.insert(indices.end(),
                           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    const std::vector<std::uint32_t> original = indices;
    std::vector<std::uint32_t>* lists[] = {&indices};
    const VertexBlock made = withTangents(block, lists, 0);
    ASSERT_EQ(made.vertices.tangents.size(), made.vertices.count());
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const glm::vec4& tangent = made.vertices.tangents[indices[i]];
        // A chord between neighbouring vertices of a circle deviates from the tangent by π/around. At a seam, a vertex
        // has a chord on one side only, so the deviations of two chords do not cancel. Twice this deviation is allowed.
        ASSERT_GT(glm::dot(glm::vec3(tangent), along[original[i]]), std::cos(2 * std::numbers::pi / around)) << i;
        ASSERT_EQ(tangent.w, 1) << i;
    }
}

// Computed tangents agree with tangents that another program has stored in a model's file.
TEST(Tangents, agreeWithThoseOfARealModel) {
    DEFOCUS_MODEL_OR_SKIP(path, "WaterBottle.glb");
    const Mesh mesh = loadGltf(path).meshes.at(0);
    ASSERT_FALSE(mesh.vertices.tangents.empty());
    VertexBlock block{mesh.vertices, {}};
    block.vertices.tangents.clear();
    std::vector<std::uint32_t> indices = mesh.primitives.at(0).indices;
    const std::vector<std::uint32_t> original = indices;
    std::vector<std::uint32_t>* lists[] = {&indices};
    const VertexBlock made = withTangents(block, lists, 0);
    std::size_t alike = 0;
    std::size_t sameHand = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const glm::vec4& theirs = mesh.vertices.tangents[original[i]];
        const glm::vec4& ours = made.vertices.tangents[indices[i]];
        alike += glm::dot(glm::vec3(theirs), glm::vec3(ours)) > 0.97f ? 1 : 0;
        sameHand += theirs.w == ours.w ? 1 : 0;
    }
    EXPECT_GT(static_cast<double>(alike), 0.97 * static_cast<double>(indices.size()));
    EXPECT_GT(static_cast<double>(sameHand), 0.99 * static_cast<double>(indices.size()));
}

TEST(VertexBlock, perpendicularIsPerpendicular) {
    for (const glm::vec3 axis :
         {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
        EXPECT_NEAR(glm::dot(perpendicular(axis), axis), 0, 1e-6);
        EXPECT_NEAR(glm::length(perpendicular(axis)), 1, 1e-6);
    }
}

}  // namespace
}  // namespace defocus::engine
