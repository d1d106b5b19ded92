#include "lod/pyramid/clusters.h"

#include <gtest/gtest.h>

#include "lod/invariants.h"
#include "lod/pyramid/pyramid.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

TEST(Clusters, boundsHoldForEveryTriangle) {
    expectClustersHold(buildPyramid(torus(64, 40)));
    expectClustersHold(buildPyramid(sphere(60, 40)));
}

TEST(Clusters, conesAreNarrow) {
    const Pyramid pyramid = buildPyramid(sphere(200, 120));
    const PyramidLevel& level = pyramid.levels[0];
    std::size_t narrow = 0;
    for (const Cluster& cluster : level.clusters) narrow += cluster.minCosine > 0.9 ? 1 : 0;
    // A disk with the area of 64 of the sphere's 47,600 triangles, the max of a cluster, has an angular radius of 4.2°.
    // The normals of most clusters therefore lie well within 26° (cosine 0.9) of the cone's axis.
    EXPECT_GT(static_cast<double>(narrow), 0.85 * static_cast<double>(level.clusters.size()));
    EXPECT_LT(level.clusters.size() * maxClusterTriangles, 1.5 * level.triangleCount);
}

TEST(Clusters, anEmptyMeshHasNone) {
    EXPECT_TRUE(buildPyramid(Mesh{}).levels[0].clusters.empty());
}

TEST(Clusters, collapsedTrianglesDontCountAndNeedlesDo) {
    Vertices vertices;
    vertices.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5f, 0, 0}};
    vertices.normals.assign(5, {0, 0, 1});
    EXPECT_NEAR(buildPyramid(singlePrimitive(vertices, {0, 1, 2, 1, 3, 2, 1, 1, 2})).levels[0].clusters[0].minAltitude,
                std::sqrt(0.5), 1e-5);
    EXPECT_EQ(buildPyramid(singlePrimitive(vertices, {0, 1, 2, 0, 4, 1})).levels[0].clusters[0].minAltitude, 0);
}

}  // namespace
}  // namespace defocus::engine
