#include "lod/pyramid/draft.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/pyramid/surface_distance.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

TEST(Draft, isTheMeshRoughlyFromFewTriangles) {
    const Mesh mesh = bumpySphere(200, 200, 3);
    const Pyramid draft = draftPyramid(mesh, 2000);
    ASSERT_EQ(draft.levels.size(), 1u);
    EXPECT_LE(draft.levels[0].triangleCount, 3000u);
    EXPECT_GT(draft.levels[0].triangleCount, 500u);
    for (const glm::vec3& p : draft.levels[0].positions) EXPECT_NEAR(glm::length(p), 1, 0.031);
    const Surface shown = prepareSurface(draft.levels[0].positions, draft.indices);
    const Surface full = prepareSurface(mesh.vertices.positions, mesh.primitives[0].indices);
    EXPECT_LT(surfaceDistance(shown, full, 500).both.percentile99, 0.06);
}

TEST(Draft, verticesAreSomeOfTheMeshs) {
    const Mesh mesh = bumpySphere(100, 60, 0);
    const Pyramid draft = draftPyramid(mesh, 700);
    ASSERT_EQ(draft.source.size(), draft.vertices.count());
    for (std::size_t v = 0; v < draft.source.size(); ++v) {
        EXPECT_EQ(draft.vertices.positions[v], mesh.vertices.positions[draft.source[v]]);
        EXPECT_EQ(draft.vertices.colors[v], mesh.vertices.colors[draft.source[v]]);
    }
}

TEST(Draft, trianglesThatShareNoVertexGetFewerToo) {
    const Mesh mesh = bumpySphere(100, 60, 0);
    Mesh soup;
    for (const std::uint32_t index : mesh.primitives[0].indices)
        soup.vertices.positions.push_back(1.01f * mesh.vertices.positions[index] +
                                          0.001f * static_cast<float>(soup.vertices.count() / 3 % 7));
    soup.primitives = {{0, {}}};
    for (std::uint32_t i = 0; i < soup.vertices.count(); ++i) soup.primitives[0].indices.push_back(i);
    const Pyramid draft = draftPyramid(soup, 700);
    EXPECT_LE(draft.levels[0].triangleCount, 1050u);
    EXPECT_GT(draft.levels[0].triangleCount, 100u);
}

TEST(Draft, primitivesStayApartAndInOrder) {
    Mesh mesh = bumpySphere(100, 60, 5);
    const Primitive full = mesh.primitives[0];
    const auto middle = static_cast<std::ptrdiff_t>(full.indices.size() / 6 * 3);
    mesh.primitives = {{5, {full.indices.begin(), full.indices.begin() + middle}},
                       {6, {}},
                       {7, {full.indices.begin() + middle, full.indices.end()}}};
    const Pyramid draft = draftPyramid(mesh, 1000);
    ASSERT_EQ(draft.levels[0].primitives.size(), 3u);
    EXPECT_GT(draft.levels[0].primitives[0].count, 0u);
    EXPECT_EQ(draft.levels[0].primitives[1].count, 0u);
    EXPECT_GT(draft.levels[0].primitives[2].count, 0u);
}

TEST(Draft, smallAndEmptyMeshesAreWhole) {
    const Mesh mesh = bumpySphere(12, 8, 0);
    EXPECT_EQ(draftPyramid(mesh, 1000).levels[0].triangleCount, mesh.triangleCount());
    EXPECT_EQ(draftPyramid(Mesh{}, 1000).levels.at(0).triangleCount, 0u);
}

}  // namespace
}  // namespace defocus::engine
