#include "lod/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lod/pyramid.h"
#include "shapes.h"

namespace defocus {
namespace {

// All that a cluster says holds for its triangles, and clusters tile the ranges of the primitives.
void expectClustersHold(const Pyramid& pyramid) {
    for (const PyramidLevel& level : pyramid.levels) {
        auto cluster = level.clusters.begin();
        for (const IndexRange& primitive : level.primitives)
            for (std::uint32_t next = primitive.first; next < primitive.first + primitive.count; ++cluster) {
                ASSERT_NE(cluster, level.clusters.end());
                ASSERT_EQ(cluster->indices.first, next);
                ASSERT_LE(cluster->indices.count, 3 * mostClusterTriangles);
                next += cluster->indices.count;
            }
        EXPECT_EQ(cluster, level.clusters.end());
        for (const Cluster& c : level.clusters)
            for (std::uint32_t i = c.indices.first; i < c.indices.first + c.indices.count; i += 3) {
                glm::dvec3 p[3];
                for (std::uint32_t k = 0; k < 3; ++k) p[k] = glm::dvec3(level.positions[pyramid.indices[i + k]]);
                for (const glm::dvec3& corner : p) EXPECT_LE(glm::distance(corner, glm::dvec3(c.centre)), c.radius);
                const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
                const double longest =
                    std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
                EXPECT_GE(glm::length(cross) / longest, c.leastAltitude);
                const glm::dvec3 normal = glm::normalize(cross);
                EXPECT_GE(glm::dot(normal, glm::dvec3(c.axis)), c.leastCosine);
                EXPECT_GE(glm::dot(normal, p[0] - glm::dvec3(c.centre)), c.planes);
            }
    }
}

TEST(Clusters, boundsHoldForEveryTriangle) {
    expectClustersHold(buildPyramid(torus(64, 40)));
    expectClustersHold(buildPyramid(sphere(60, 40)));
}

TEST(Clusters, conesAreNarrow) {
    const Pyramid pyramid = buildPyramid(sphere(200, 120));
    const PyramidLevel& level = pyramid.levels[0];
    std::size_t narrow = 0;
    for (const Cluster& cluster : level.clusters) narrow += cluster.leastCosine > 0.9 ? 1 : 0;
    // 64 of 47,600 triangles of equal size would cover a disk of 4.2° about its middle.
    EXPECT_GT(static_cast<double>(narrow), 0.85 * static_cast<double>(level.clusters.size()));
    EXPECT_LT(level.clusters.size() * mostClusterTriangles, 1.5 * level.triangleCount);
}

TEST(Clusters, anEmptyMeshHasNone) {
    EXPECT_TRUE(buildPyramid(Mesh{}).levels[0].clusters.empty());
}

TEST(Clusters, collapsedTrianglesDontCountAndNeedlesDo) {
    Vertices vertices;
    vertices.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5f, 0, 0}};
    vertices.normals.assign(5, {0, 0, 1});
    EXPECT_NEAR(
        buildPyramid(singlePrimitive(vertices, {0, 1, 2, 1, 3, 2, 1, 1, 2})).levels[0].clusters[0].leastAltitude,
        std::sqrt(0.5), 1e-5);
    EXPECT_EQ(buildPyramid(singlePrimitive(vertices, {0, 1, 2, 0, 4, 1})).levels[0].clusters[0].leastAltitude, 0);
}

}  // namespace
}  // namespace defocus
