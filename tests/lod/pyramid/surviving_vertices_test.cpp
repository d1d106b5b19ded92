// Tests levels of detail as in Jeong, Kim and Lee 2011: their vertices are vertices of the mesh, with unchanged
// attributes.

#include <gtest/gtest.h>

#include <set>

#include "lod/invariants.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// Gives each vertex its own colour and a second set of texture coordinates.
Mesh coloured(Mesh mesh) {
    const auto count = static_cast<float>(mesh.vertices.count());
    for (std::size_t v = 0; v < mesh.vertices.count(); ++v) {
        mesh.vertices.colors.emplace_back(static_cast<float>(v) / count, 0.5f, 0.25f, 1);
        mesh.vertices.uv1.push_back(2.0f * mesh.vertices.uv0[v]);
    }
    return mesh;
}

// Counts vertices of the coarser levels: `all` is the number of all vertices, and each other member is the number of
// vertices whose attribute equals that of their source vertex in the mesh.
struct OwnValues {
    std::size_t positions = 0, normals = 0, colors = 0, uv0 = 0, uv1 = 0;
    std::size_t all = 0;
};

OwnValues ownValues(const Mesh& mesh, const Pyramid& pyramid) {
    OwnValues own;
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const PyramidLevel& level = pyramid.levels[l];
        for (std::uint32_t v = 0; v < level.vertexCount; ++v) {
            const std::uint32_t source = pyramid.source[v];
            ++own.all;
            own.positions += level.positions[v] == mesh.vertices.positions[source] ? 1 : 0;
            own.normals += level.normals[v] == mesh.vertices.normals[source] ? 1 : 0;
            own.colors += level.colors[v] == mesh.vertices.colors[source] ? 1 : 0;
            own.uv0 += level.uv0[v] == mesh.vertices.uv0[source] ? 1 : 0;
            own.uv1 += level.uv1[v] == mesh.vertices.uv1[source] ? 1 : 0;
        }
    }
    return own;
}

const PyramidOptions asPublished{.vertices = LevelVertices::surviving};

TEST(SurvivingVertices, haveTheValuesOfLevel0) {
    for (const Mesh& mesh : {coloured(sphere(64, 32, 0.1)), coloured(torus(64, 40)), coloured(flatGrid(48))}) {
        const Pyramid pyramid = buildPyramid(mesh, asPublished);
        ASSERT_GT(pyramid.levels.size(), 3u);
        const OwnValues own = ownValues(mesh, pyramid);
        EXPECT_EQ(own.positions, own.all);
        EXPECT_EQ(own.normals, own.all);
        EXPECT_EQ(own.colors, own.all);
        EXPECT_EQ(own.uv0, own.all);
        EXPECT_EQ(own.uv1, own.all);
    }
}

// In levels with fitted vertices, fewer than half of the vertices have the position, the normal or the colour of their
// source vertex in the mesh. These counts therefore distinguish fitted vertices from surviving (unchanged) vertices.
TEST(SurvivingVertices, areNotThoseOfFittedLevels) {
    const Mesh mesh = coloured(sphere(64, 32, 0.1));
    const OwnValues own = ownValues(mesh, buildPyramid(mesh));
    EXPECT_LT(own.positions, own.all / 2);
    EXPECT_LT(own.normals, own.all / 2);
    EXPECT_LT(own.colors, own.all / 2);
}

// Levels consist of the same vertices of the mesh, whether the attributes of these vertices are fitted to the mesh or
// unchanged.
TEST(SurvivingVertices, areThoseThatFittedLevelsHave) {
    const Mesh mesh = coloured(torus(64, 40));
    const Pyramid published = buildPyramid(mesh, asPublished);
    const Pyramid fitted = buildPyramid(mesh);
    const auto sources = [](const Pyramid& pyramid, std::uint32_t count) {
        return std::multiset<std::uint32_t>(pyramid.source.begin(), pyramid.source.begin() + count);
    };
    ASSERT_EQ(published.levels.size(), fitted.levels.size());
    for (std::size_t l = 0; l < fitted.levels.size(); ++l) {
        const std::uint32_t count = fitted.levels[l].vertexCount;
        ASSERT_EQ(published.levels[l].vertexCount, count);
        EXPECT_EQ(published.levels[l].triangleCount, fitted.levels[l].triangleCount);
        EXPECT_EQ(sources(published, count), sources(fitted, count)) << "level " << l;
    }
}

std::size_t placesOf(const Pyramid& pyramid, const PyramidLevel& level) {
    std::set<std::array<float, 3>> places;
    for (const IndexRange& range : level.primitives)
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const glm::vec3& p = level.positions[pyramid.indices[i]];
            places.insert({p.x, p.y, p.z});
        }
    return places.size();
}

// The option `quarters` makes three levels, with all, three quarters and half of the vertex positions. This holds for
// closed and open surfaces, with and without seams.
TEST(Quarters, areThreeLevelsOfAllThreeQuartersAndHalfOfTheVertices) {
    for (const Mesh& mesh : {coloured(sphere(64, 32, 0.1)), coloured(torus(64, 40)), coloured(flatGrid(48))}) {
        const Pyramid pyramid = buildPyramid(mesh, {.vertices = LevelVertices::quarters});
        ASSERT_EQ(pyramid.levels.size(), 3u);
        const auto all = static_cast<double>(placesOf(pyramid, pyramid.levels[0]));
        EXPECT_EQ(placesOf(pyramid, pyramid.levels[1]), std::ceil(0.75 * all));
        EXPECT_EQ(placesOf(pyramid, pyramid.levels[2]), std::ceil(0.5 * all));
        const OwnValues own = ownValues(mesh, pyramid);
        EXPECT_EQ(own.positions, own.all);
        EXPECT_LT(pyramid.levels[0].meanEdge, pyramid.levels[1].meanEdge);
        EXPECT_LT(pyramid.levels[1].meanEdge, pyramid.levels[2].meanEdge);
    }
}

// Each level has half the triangles of the previous level, to within 1.5 triangles: half is rounded down, and the last
// collapse, which removes two triangles, may remove one too many.
TEST(SurvivingVertices, makeLevelsOfHalfTheTriangles) {
    const Pyramid pyramid = buildPyramid(sphere(96, 48), asPublished);
    ASSERT_GT(pyramid.levels.size(), 5u);
    for (std::size_t l = 1; l + 1 < pyramid.levels.size(); ++l)
        EXPECT_NEAR(pyramid.levels[l].triangleCount, pyramid.levels[l - 1].triangleCount / 2.0, 1.5) << "level " << l;
}

TEST(SurvivingVertices, keepThePyramidSound) {
    const Mesh mesh = sphere(64, 32, 0.1);
    expectPyramidInvariants(mesh, buildPyramid(mesh, asPublished));
}

}  // namespace
}  // namespace defocus::engine
