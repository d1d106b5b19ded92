#pragma once
// What holds for every pyramid, whatever its mesh.

#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>

#include "shapes.h"

namespace defocus {

inline void expectPyramidInvariants(const Mesh& mesh, const Pyramid& pyramid) {
    ASSERT_FALSE(pyramid.levels.empty());
    std::vector<std::uint32_t> all;
    for (const Primitive& primitive : mesh.primitives)
        all.insert(all.end(), primitive.indices.begin(), primitive.indices.end());
    EXPECT_EQ(triangleSet(pyramid.vertices.positions, levelIndices(pyramid, 0)),
              triangleSet(mesh.vertices.positions, all))
        << "level 0 keeps every triangle";
    ASSERT_EQ(pyramid.source.size(), pyramid.vertices.count());
    for (std::size_t v = 0; v < pyramid.source.size(); ++v)
        ASSERT_EQ(pyramid.vertices.positions[v], mesh.vertices.positions[pyramid.source[v]]);

    EXPECT_EQ(pyramid.levels[0].error, 0);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        SCOPED_TRACE(testing::Message() << "level " << l);
        const PyramidLevel& level = pyramid.levels[l];
        ASSERT_EQ(level.primitives.size(), mesh.primitives.size());
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        ASSERT_EQ(indices.size(), 3 * std::size_t{level.triangleCount});
        for (const std::uint32_t index : indices) ASSERT_LT(index, level.vertexCount);
        ASSERT_EQ(level.positions.size(), level.vertexCount);
        for (std::size_t v = 0; v < level.positions.size(); ++v) {
            const glm::dvec3 p = level.positions[v];
            ASSERT_FALSE(l == 0 && level.positions[v] != pyramid.vertices.positions[v]);
            ASSERT_FALSE(glm::any(glm::lessThan(p, pyramid.bounds.minimum)) ||
                         glm::any(glm::greaterThan(p, pyramid.bounds.maximum)));
        }
        ASSERT_EQ(level.normals.size(), level.vertexCount);
        for (const glm::vec3& normal : level.normals) {
            ASSERT_LE(glm::length(normal), 1 + 1e-3);
            ASSERT_GT(glm::length(normal), l == 0 ? 1 - 1e-3 : 0.1);
        }
        ASSERT_EQ(level.colors.size(), mesh.vertices.colors.empty() ? 0 : level.vertexCount);
        if (l == 0) continue;
        const PyramidLevel& finer = pyramid.levels[l - 1];
        EXPECT_LE(level.vertexCount, finer.vertexCount);
        EXPECT_LE(level.triangleCount, 0.75 * finer.triangleCount);
        EXPECT_GT(level.meanEdge, finer.meanEdge);
        EXPECT_GT(level.error, 0);
        EXPECT_GE(level.error, 1.25 * finer.error);
    }
}

}  // namespace defocus
