// Tests the simplification of meshes of many separate parts: once all parts have their min size, whole parts are
// removed.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <set>

#include "lod/invariants.h"
#include "lod/pyramid/surface_distance.h"

namespace defocus::engine {
namespace {

using SizeOf = std::function<float(std::uint32_t)>;

// Returns scattered tetrahedra. Tetrahedron i has edges of √2 · sizeOf(i).
Mesh tetrahedra(std::uint32_t count, const SizeOf& sizeOf) {
    Vertices vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(vertices.positions.size());
        for (const glm::vec3 corner : {glm::vec3(0, 0, 0), {1, 1, 0}, {0, 1, 1}, {1, 0, 1}})
            vertices.positions.push_back(scatteredPlace(i) + sizeOf(i) * corner);
        for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 2u, 1u, 0u, 3u, 2u, 1u, 2u, 3u})
            indices.push_back(first + corner);
    }
    return singlePrimitive(std::move(vertices), std::move(indices));
}

// Returns scattered squares of side `size`. All squares face +z.
Mesh leaves(std::uint32_t count, float size) {
    Vertices vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(vertices.positions.size());
        for (const glm::vec3 corner : {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
            vertices.positions.push_back(scatteredPlace(i) + size * corner);
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + corner);
    }
    return singlePrimitive(std::move(vertices), std::move(indices));
}

// Returns the indices of the parts (connected components of the mesh) that a level contains. Each part of the mesh has
// `cornersEach` vertices.
std::set<std::uint32_t> partsOf(const Pyramid& pyramid, std::size_t level, std::uint32_t cornersEach) {
    std::set<std::uint32_t> parts;
    for (const std::uint32_t v : levelIndices(pyramid, level)) parts.insert(pyramid.source[v] / cornersEach);
    return parts;
}

// Returns the largest distance from a vertex of a removed part (connected component of the mesh) to the level.
double lackedDistance(const Mesh& mesh, const Pyramid& pyramid, std::size_t level, std::uint32_t cornersEach) {
    const std::set<std::uint32_t> parts = partsOf(pyramid, level, cornersEach);
    const Surface surface = prepareSurface(pyramid.levels[level].positions, levelIndices(pyramid, level));
    double largest = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.count(); ++v)
        if (!parts.contains(v / cornersEach))
            largest = std::max(largest, distanceTo(surface, mesh.vertices.positions[v]));
    return largest;
}

TEST(Components, AHeapOfThemComesDownToTheFloorAndIsNeverEmpty) {
    const Mesh mesh =
        tetrahedra(2000, [](std::uint32_t i) { return 0.004f + 0.000002f * static_cast<float>(i % 997); });
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        EXPECT_TRUE(isClosed(pyramid.levels[l].positions, levelIndices(pyramid, l))) << "level " << l;
        EXPECT_EQ(partsOf(pyramid, l, 4).size(), pyramid.levels[l].triangleCount / 4) << "level " << l;
    }
}

TEST(Components, StoredErrorBoundsTheDistanceAndTheSizeOfWhatIsGone) {
    const auto sizeOf = [](std::uint32_t i) { return 0.004f * std::exp2(static_cast<float>(i % 5) / 2); };
    const Mesh mesh = tetrahedra(1500, sizeOf);
    const Pyramid pyramid = buildPyramid(mesh);
    ASSERT_GT(pyramid.levels.size(), 3u);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        EXPECT_GE(pyramid.levels[l].error, lackedDistance(mesh, pyramid, l, 4)) << "level " << l;
        const std::set<std::uint32_t> parts = partsOf(pyramid, l, 4);
        for (std::uint32_t i = 0; i < 1500; ++i)
            if (!parts.contains(i)) {
                ASSERT_GE(pyramid.levels[l].error, std::numbers::sqrt2 * sizeOf(i)) << "level " << l;
            }
    }
}

TEST(Components, SmallerOnesGoFirstAndTheLargestStays) {
    // Part 777 is the largest. The other parts have nine sizes in mixed order; each size is 1.3 times the next smaller
    // one.
    const auto sizeOf = [](std::uint32_t i) {
        return i == 777 ? 0.05f : 0.002f * std::pow(1.3f, static_cast<float>(i * 7 % 9));
    };
    const Mesh mesh = tetrahedra(1800, sizeOf);
    const Pyramid pyramid = buildPyramid(mesh);
    ASSERT_GT(pyramid.levels.size(), 4u);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const std::set<std::uint32_t> parts = partsOf(pyramid, l, 4);
        EXPECT_TRUE(parts.contains(777)) << "level " << l;
        float largestGone = 0;
        float smallestLeft = std::numeric_limits<float>::infinity();
        for (std::uint32_t i = 0; i < 1800; ++i)
            if (parts.contains(i))
                smallestLeft = std::min(smallestLeft, sizeOf(i));
            else
                largestGone = std::max(largestGone, sizeOf(i));
        EXPECT_LE(largestGone, smallestLeft) << "level " << l;
    }
}

// Levels keep the total area of the leaves: those that remain grow until they touch each other. Without growth, half
// the leaves would cover half the area.
TEST(Components, AreaIsKeptWhileThereIsRoomForIt) {
    const Mesh mesh = leaves(4000, 0.002f);
    const Pyramid pyramid = buildPyramid(mesh);
    const double full = surfaceArea(mesh.vertices.positions, mesh.primitives[0].indices);
    ASSERT_GT(pyramid.levels.size(), 5u);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l)
        EXPECT_NEAR(surfaceArea(pyramid.levels[l].positions, levelIndices(pyramid, l)), full, 0.08 * full)
            << "level " << l;
}

TEST(Components, WhatIsGoneIsMissedEvenlyOverTheMesh) {
    // Each quarter of the unit square keeps a quarter of the parts, since all parts have the same size.
    const Mesh mesh = tetrahedra(2048, [](std::uint32_t) { return 0.004f; });
    const Pyramid pyramid = buildPyramid(mesh);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        std::array<double, 4> counts{};
        const std::set<std::uint32_t> parts = partsOf(pyramid, l, 4);
        for (const std::uint32_t i : parts) {
            const glm::vec3 place = scatteredPlace(i);
            counts[(place.x < 0.5f ? 0u : 1u) + (place.y < 0.5f ? 0u : 2u)] += 1;
        }
        // The tolerance is four standard deviations of a fair random selection.
        const auto n = static_cast<double>(parts.size());
        for (const double count : counts) EXPECT_NEAR(count, n / 4, 4 * std::sqrt(n * 3 / 16)) << "level " << l;
    }
}

TEST(Components, ASingleOneIsNeverRemoved) {
    for (const Mesh& mesh : {torus(6, 4), tetrahedra(1, [](std::uint32_t) { return 1.0f; })}) {
        const PyramidOptions options{.minTriangles = 1};
        const Pyramid pyramid = buildPyramid(mesh, options);
        EXPECT_GT(pyramid.levels.back().triangleCount, 3u);
        EXPECT_TRUE(isClosed(pyramid.levels.back().positions, levelIndices(pyramid, pyramid.levels.size() - 1)));
    }
}

// Collapses simplify a large part as far as possible before any small part is removed.
TEST(Components, CollapsesComeFirst) {
    Mesh mesh = tetrahedra(40, [](std::uint32_t) { return 0.01f; });
    const Mesh ball = sphere(64, 32);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.count());
    for (const glm::vec3& p : ball.vertices.positions) mesh.vertices.positions.push_back(p + glm::vec3(0.5f, 0.5f, 2));
    mesh.vertices.normals.insert(mesh.vertices.normals.end(), ball.vertices.normals.begin(),
                                 ball.vertices.normals.end());
    for (const std::uint32_t v : ball.primitives[0].indices) mesh.primitives[0].indices.push_back(first + v);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l)
        if (pyramid.levels[l].triangleCount > 300) {
            std::set<std::uint32_t> parts;
            for (const std::uint32_t v : levelIndices(pyramid, l))
                if (pyramid.source[v] < first) parts.insert(pyramid.source[v] / 4);
            EXPECT_EQ(parts.size(), 40u) << "level " << l;
        }
    EXPECT_LE(pyramid.levels.back().triangleCount, 64u);
}

}  // namespace
}  // namespace defocus::engine
