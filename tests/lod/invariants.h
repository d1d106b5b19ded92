#pragma once
// Checks properties that the pyramid (levels of detail) of any mesh must have.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>

#include "lod/pyramid/level_selection.h"
#include "lod/pyramid/surface_distance.h"
#include "lod/shapes.h"

namespace defocus::engine {

// Expects each cluster's bounds (bounding sphere, normal cone, smallest triangle altitude) to hold for its triangles.
// The clusters must cover the index ranges of the primitives without gaps or overlaps.
inline void expectClustersHold(const Pyramid& pyramid) {
    for (const PyramidLevel& level : pyramid.levels) {
        auto cluster = level.clusters.begin();
        for (const IndexRange& primitive : level.primitives)
            for (std::uint32_t next = primitive.first; next < primitive.first + primitive.count; ++cluster) {
                ASSERT_NE(cluster, level.clusters.end());
                ASSERT_EQ(cluster->indices.first, next);
                ASSERT_LE(cluster->indices.count, 3 * maxClusterTriangles);
                next += cluster->indices.count;
            }
        EXPECT_EQ(cluster, level.clusters.end());
        for (const Cluster& c : level.clusters)
            for (std::uint32_t i = c.indices.first; i < c.indices.first + c.indices.count; i += 3) {
                glm::dvec3 p[3];
                for (std::uint32_t k = 0; k < 3; ++k) p[k] = glm::dvec3(level.positions[pyramid.indices[i + k]]);
                for (const glm::dvec3& corner : p) ASSERT_LE(glm::distance(corner, glm::dvec3(c.centre)), c.radius);
                if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;  // degenerate triangles cover no pixels
                const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
                const double longest =
                    std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
                ASSERT_GE(glm::length(cross) / longest, c.minAltitude);
                if (!(glm::length(cross) > 0)) continue;
                const glm::dvec3 normal = glm::normalize(cross);
                ASSERT_GE(glm::dot(normal, glm::dvec3(c.axis)), c.minCosine);
                ASSERT_GE(glm::dot(normal, p[0] - glm::dvec3(c.centre)), c.planes);
            }
    }
}

// Expects the selected real-valued level λ to increase without jumps, from 0 to the coarsest level, as the target (an
// edge length or an error in px) increases. In every pyramid, edges grow by at least 5 % and errors by at least 25 %
// from one level to the next. This growth bounds the slope of λ over log(target). For errors, the slope between two
// levels is largest at the coarser level, so the bound is computed there.
inline void expectContinuousLevels(const Pyramid& pyramid) {
    if (pyramid.levels.size() < 2) return;
    constexpr double step = 1.0005;
    for (const LodMetric metric : {LodMetric::size, LodMetric::error}) {
        const auto stored = [&](const PyramidLevel& level) {
            return metric == LodMetric::size ? level.meanEdge : level.error;
        };
        const double max = metric == LodMetric::size ? std::log(step) / std::log(1.05) : (step - 1) / (1 - 1 / 1.25);
        const double pixelsPerUnit = 10 / stored(pyramid.levels[1]);
        const double end = 1.1 * pixelsPerUnit * stored(pyramid.levels.back());
        double last = 0;
        for (double target = 1e-3; target < end; target *= step) {
            const double lambda = levelOfDetail(pyramid, {pixelsPerUnit, 0, 0}, metric, {0, target});
            ASSERT_GE(lambda, last) << "at " << target;
            ASSERT_LE(lambda - last, 1.001 * max) << "at " << target;
            last = lambda;
        }
        EXPECT_EQ(last, static_cast<double>(pyramid.levels.size() - 1));
    }
}

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
        ASSERT_EQ(level.uv0.size(), mesh.vertices.uv0.empty() ? 0 : level.vertexCount);
        ASSERT_EQ(level.uv1.size(), mesh.vertices.uv1.empty() ? 0 : level.vertexCount);
        if (l == 0) continue;
        const PyramidLevel& finer = pyramid.levels[l - 1];
        EXPECT_LE(level.vertexCount, finer.vertexCount);
        EXPECT_LE(level.triangleCount, 0.75 * finer.triangleCount);
        EXPECT_GT(level.meanEdge, finer.meanEdge);
        EXPECT_GT(level.error, 0);
        EXPECT_GE(level.error, 1.25 * finer.error);
    }
    expectClustersHold(pyramid);
    expectContinuousLevels(pyramid);
}

// Expects the connected part with the largest area to keep its shape, except in levels in which it has the most
// triangles of all parts.
inline void expectMainPartLasts(const Mesh& mesh, const Pyramid& pyramid) {
    const std::vector<std::uint32_t> parts = partsByPosition(mesh);
    const auto partIndices = [&](std::size_t level) {
        std::map<std::uint32_t, std::vector<std::uint32_t>> indices;
        const std::vector<std::uint32_t> all = levelIndices(pyramid, level);
        for (const std::uint32_t v : all) indices[parts[pyramid.source[v]]].push_back(v);
        return indices;
    };
    const std::vector<glm::vec3>& positions = pyramid.levels[0].positions;
    const auto finest = partIndices(0);
    const auto& [main, mainIndices] =
        *std::max_element(finest.begin(), finest.end(), [&](const auto& a, const auto& b) {
            return surfaceArea(positions, a.second) < surfaceArea(positions, b.second);
        });
    const Surface surface = prepareSurface(positions, mainIndices);
    Bounds bounds;
    for (const std::uint32_t v : mainIndices) bounds.extend(glm::dvec3(positions[v]));
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const auto coarse = partIndices(l);
        ASSERT_TRUE(coarse.contains(main)) << "level " << l;
        const std::vector<std::uint32_t>& own = coarse.at(main);
        const bool max = std::all_of(coarse.begin(), coarse.end(),
                                     [&](const auto& part) { return part.second.size() <= own.size(); });
        if (max) continue;
        const Surface left = prepareSurface(pyramid.levels[l].positions, own);
        EXPECT_LT(surfaceDistance(surface, left, 4096).both.mean, 0.03 * glm::length(bounds.size()))
            << "level " << l << ": " << own.size() / 3 << " triangles";
    }
}

}  // namespace defocus::engine
