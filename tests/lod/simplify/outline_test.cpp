#include "lod/simplify/outline.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>

#include "lod/shapes.h"
#include "lod/simplify/weld.h"

namespace defocus::engine {
namespace {

// Index of the direction −x in directionsOfOutlines().
constexpr std::size_t towardsMinusX = 4;

TEST(CoverGrid, coversWhatTrianglesOfEitherSideDo) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    Bounds box;
    for (const glm::vec3& p : positions) box.extend(glm::dvec3(p));
    const std::vector<std::uint32_t> oneTurned = {0, 1, 2, 0, 3, 2};
    CoverGrid grid(box, {0, 0, 1}, 512);
    grid.add(positions, oneTurned);
    EXPECT_NEAR(grid.area(), 1, 0.01);
    EXPECT_TRUE(grid.covers(grid.cellsOf({0.5f, 0.5f, 0})));
    EXPECT_FALSE(grid.covers(grid.cellsOf({1.1f, 0.5f, 0})));
    EXPECT_EQ(grid.emptied().area(), 0);
    CoverGrid edgeOn(box, {1, 0, 0}, 512);
    edgeOn.add(positions, oneTurned);
    EXPECT_EQ(edgeOn.area(), 0);
}

TEST(CoverGrid, ofAnEmptyBoxIsEmpty) {
    CoverGrid grid(Bounds(), directionsOfOutlines()[towardsMinusX], 256);
    grid.add({}, {});
    EXPECT_EQ(grid.area(), 0);
    EXPECT_FALSE(grid.covers({0, 0}));
}

TEST(EdgeFill, coversWhatTheTrianglesOfItsEdgesDo) {
    const Mesh mesh = sphere(32, 16);
    const std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    CoverGrid byTriangles(mesh.bounds(), directionsOfOutlines()[0], 512);
    CoverGrid byEdges = byTriangles;
    byTriangles.add(mesh.vertices.positions, indices);
    EdgeFill fill(byEdges.resolution());
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        glm::dvec2 corners[3];
        for (std::size_t k = 0; k < 3; ++k) corners[k] = byEdges.cellsOf(mesh.vertices.positions[indices[i + k]]);
        const glm::dvec2 b = corners[1] - corners[0];
        const glm::dvec2 c = corners[2] - corners[0];
        const int left = b.x * c.y > b.y * c.x ? 1 : -1;
        for (std::size_t k = 0; k < 3; ++k) fill.add(corners[k], corners[(k + 1) % 3], left);
    }
    const std::size_t cells = fill.fill(byEdges);
    EXPECT_NEAR(byEdges.area() / byTriangles.area(), 1, 1e-4);
    EXPECT_DOUBLE_EQ(byEdges.area(), byEdges.cell() * byEdges.cell() * static_cast<double>(cells));
    EXPECT_EQ(fill.fill(byEdges), 0u) << "fill() must remove the edges";
}

// A fit enlarges the outlines of a coarse sphere to the area of the fine sphere's outlines. Before the fit, every
// outline is too small, as all vertices lie on the fine sphere.
TEST(FitOutlines, inscribedSphereGrowsToTheAreaOfTheFineOne) {
    const Mesh fine = sphere(128, 64);
    const Mesh coarse = sphere(12, 8);
    const Bounds box = fine.bounds();
    const std::vector<CoverGrid> outlines = outlinesOf(fine.vertices.positions, fine.primitives[0].indices, box);
    const WeldedPositions welded = weldPositions(coarse.vertices.positions);
    std::vector<std::uint32_t> places;
    for (const PositionNumber place : welded.id) places.push_back(place.value);
    const std::vector<std::uint32_t>& indices = coarse.primitives[0].indices;
    const auto worst = [&](const std::vector<glm::vec3>& positions) {
        double largest = 0;
        for (const CoverGrid& level0 : outlines) {
            CoverGrid own = level0.emptied();
            own.add(positions, indices);
            largest = std::max(largest, std::abs(own.area() / level0.area() - 1));
        }
        return largest;
    };
    std::vector<glm::vec3> fitted = coarse.vertices.positions;
    ASSERT_GT(worst(fitted), 0.05);
    fitOutlines(fitted, indices, places, outlines, box);
    EXPECT_LT(worst(fitted), 0.005);
    for (std::uint32_t v = 0; v < fitted.size(); ++v) {
        EXPECT_EQ(fitted[v], fitted[welded.first[welded.id[{v}]].value]) << "the seam opens at " << v;
        const glm::dvec3 p = fitted[v];
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, box.minimum)) && glm::all(glm::lessThanEqual(p, box.maximum)));
    }
}

}  // namespace
}  // namespace defocus::engine
