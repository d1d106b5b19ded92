// Tests the coarsest level of a pyramid, and the stated reason why no coarser level follows.

#include <gtest/gtest.h>

#include <cmath>

#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// Returns the triangle count of the smallest closed surface of this genus (Jungerman and Ringel 1980). Genus 2 needs
// one vertex more than their formula gives.
std::uint32_t minOfGenus(std::uint32_t genus) {
    const auto vertices = static_cast<std::uint32_t>(std::ceil((7 + std::sqrt(1 + 48.0 * genus)) / 2));
    return 2 * (vertices + (genus == 2 ? 1 : 0)) + 4 * genus - 4;
}

TEST(PyramidEnd, SurfacesOfUpToFourHandlesReachMinTriangles) {
    for (const std::uint32_t genus : {1u, 2u, 3u, 4u}) {
        const Pyramid pyramid = buildPyramid(slab(genus, 4));
        EXPECT_LE(pyramid.levels.back().triangleCount, 64u) << genus;
        EXPECT_EQ(pyramid.end, PyramidEnd::minTriangles) << genus;
    }
    EXPECT_EQ(buildPyramid(sphere(48, 32)).end, PyramidEnd::minTriangles);
}

TEST(PyramidEnd, MoreHandlesEndWithinTwiceWhatTheyNeed) {
    for (const std::uint32_t genus : {8u, 20u, 40u}) {
        const Pyramid pyramid = buildPyramid(slab(genus, 4));
        EXPECT_GE(pyramid.levels.back().triangleCount, minOfGenus(genus)) << genus;
        EXPECT_LE(pyramid.levels.back().triangleCount, 2 * minOfGenus(genus)) << genus;
        EXPECT_EQ(pyramid.end, PyramidEnd::topology) << genus;
    }
}

TEST(PyramidEnd, ALevelThatSavesLessThanAQuarterIsNotMade) {
    const Mesh mesh = torus(24, 16);
    const PyramidOptions options{.minTriangles = static_cast<std::uint32_t>(mesh.triangleCount()) * 4 / 5};
    const Pyramid pyramid = buildPyramid(mesh, options);
    EXPECT_EQ(pyramid.levels.size(), 1u);
    EXPECT_EQ(pyramid.end, PyramidEnd::smallSaving);
}

// Neither the widest nor the largest part of a mesh is removed. The slab is the widest part and cannot be simplified
// further; the ball has most of the area.
TEST(PyramidEnd, NeitherTheWidestNorTheLargestPartGoes) {
    Mesh mesh;
    addPart(mesh, sphere(96, 48), 1, {});
    addPart(mesh, slab(30, 3), 4, {2, 0, 0});
    const Pyramid pyramid = buildPyramid(mesh);
    EXPECT_EQ(pyramid.end, PyramidEnd::largestParts);
    EXPECT_GT(pyramid.levels.back().triangleCount, minOfGenus(30) + 20);
}

TEST(PyramidEnd, WithoutASurfaceThereIsNothingToSimplify) {
    Mesh mesh = sphere(12, 8);
    for (glm::vec3& p : mesh.vertices.positions) p = glm::vec3(1);
    EXPECT_EQ(buildPyramid(mesh).end, PyramidEnd::noSurface);
    EXPECT_EQ(buildPyramid(Mesh{}).end, PyramidEnd::minTriangles);
}

TEST(PyramidEnd, AsManyLevelsAsAskedFor) {
    const PyramidOptions options{.maxLevels = 3};
    EXPECT_EQ(buildPyramid(sphere(48, 32), options).end, PyramidEnd::maxLevels);
    EXPECT_EQ(fullDetail(sphere(48, 32)).end, PyramidEnd::maxLevels);
}

// Each primitive of a level needs a draw call, so levels of a mesh with many small primitives save little.
TEST(PyramidEnd, PrimitivesOfFewTrianglesHaveNoLevels) {
    const auto divided = [](std::size_t trianglesPerPrimitive) {
        Mesh mesh = sphere(48, 32);
        const std::vector<std::uint32_t> indices = mesh.primitives.at(0).indices;
        mesh.primitives.clear();
        const std::size_t step = 3 * trianglesPerPrimitive;
        for (std::size_t i = 0; i < indices.size(); i += step)
            mesh.primitives.push_back(
                {0,
                 {indices.begin() + static_cast<std::ptrdiff_t>(i),
                  indices.begin() + static_cast<std::ptrdiff_t>(std::min(i + step, indices.size()))}});
        return buildPyramid(mesh);
    };
    EXPECT_EQ(divided(3).levels.size(), 1u);
    EXPECT_EQ(divided(3).end, PyramidEnd::smallSaving);
    EXPECT_GT(divided(8).levels.size(), 1u);
}

}  // namespace
}  // namespace defocus::engine
