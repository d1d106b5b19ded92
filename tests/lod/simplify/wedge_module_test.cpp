#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "lod/simplify/collapse.h"
#include "lod/simplify/drawn_surface.h"

namespace defocus::engine {
namespace {

// Returns a grid of 2 × 2 quads that form one UV chart.
//
// 6---7---8
// | / | / |
// 3---4---5
// | / | / |
// 0---1---2
Vertices grid() {
    Vertices vertices;
    for (int v = 0; v < 9; ++v) {
        vertices.positions.emplace_back(v % 3, v / 3, 0);
        vertices.uv0.emplace_back(v % 3, v / 3);
    }
    return vertices;
}

// Returns the grid, torn between its two columns of quads: the right column has its own vertices where it meets the
// left one. The texture coordinate u of the right column's vertices is shifted by `jump`.
//
//   6---7 11---8
//   | / |  | / |
//   3---4 10---5
//   | / |  | / |
//   0---1 9----2
Vertices tornGrid(float jump) {
    Vertices vertices = grid();
    for (const std::size_t v : {1u, 4u, 7u}) {
        vertices.positions.push_back(vertices.positions[v]);
        vertices.uv0.push_back(vertices.uv0[v]);
    }
    for (const std::size_t v : {2u, 5u, 8u, 9u, 10u, 11u}) vertices.uv0[v].x += jump;
    return vertices;
}

const std::vector<std::uint32_t> leftTriangles = {0, 1, 4, 0, 4, 3, 3, 4, 7, 3, 7, 6};
const std::vector<std::uint32_t> rightTriangles = {1, 2, 5, 1, 5, 4, 4, 5, 8, 4, 8, 7};
const std::vector<std::uint32_t> rightTrianglesOfSeam = {9, 2, 5, 9, 5, 10, 10, 5, 8, 10, 8, 11};

std::vector<std::uint32_t> together(std::vector<std::uint32_t> a, const std::vector<std::uint32_t>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(WedgeModule, insideAChartCornersDrawTheSurvivor) {
    DrawnSurface surface(grid(), {together(leftTriangles, rightTriangles)});
    EXPECT_EQ(surface.modules().wedges.judge(surface.edge(4, 5)), Fit::good);
    surface.collapse(4, 5);
    EXPECT_EQ(drawnFaces(surface.mesh()),
              (std::vector<Face>{{0, 1, 5}, {0, 5, 3}, {1, 2, 5}, {3, 5, 7}, {3, 7, 6}, {5, 8, 7}}));
}

TEST(WedgeModule, alongASeamEachSideKeepsItsOwn) {
    DrawnSurface surface(tornGrid(10), {together(leftTriangles, rightTrianglesOfSeam)});
    EXPECT_EQ(surface.modules().wedges.judge(surface.edge(4, 1)), Fit::good);
    surface.collapse(4, 1);
    EXPECT_EQ(drawnFaces(surface.mesh()),
              (std::vector<Face>{{0, 1, 3}, {1, 7, 3}, {2, 5, 9}, {3, 7, 6}, {5, 8, 9}, {8, 11, 9}}));
}

TEST(WedgeModule, leavingASeamIsPoorWhereTheTextureJumps) {
    DrawnSurface far(tornGrid(10), {together(leftTriangles, rightTrianglesOfSeam)});
    EXPECT_EQ(far.modules().wedges.judge(far.edge(4, 5)), Fit::poor);
    DrawnSurface near(tornGrid(0.5f), {together(leftTriangles, rightTrianglesOfSeam)});
    EXPECT_EQ(near.modules().wedges.judge(near.edge(4, 5)), Fit::good);
    // Triangles to the left of the seam get vertex 5, the only vertex at the surviving position, although u jumps
    // there.
    near.collapse(4, 5);
    EXPECT_EQ(drawnFaces(near.mesh()),
              (std::vector<Face>{{0, 1, 5}, {0, 5, 3}, {2, 5, 9}, {3, 5, 7}, {3, 7, 6}, {5, 8, 11}}));
}

TEST(WedgeModule, drawingAVertexOfAnotherPrimitiveIsBad) {
    DrawnSurface surface(tornGrid(0), {leftTriangles, rightTrianglesOfSeam});
    WedgeModule& wedges = surface.modules().wedges;
    EXPECT_EQ(wedges.judge(surface.edge(4, 5)), Fit::bad);
    EXPECT_EQ(wedges.judge(surface.edge(4, 3)), Fit::bad);
    EXPECT_EQ(wedges.judge(surface.edge(4, 1)), Fit::good);
    EXPECT_LT(wedges.collapse_priority(CollapseInfo(surface.mesh(), surface.edge(4, 5))), 0);
    EXPECT_EQ(wedges.collapse_priority(CollapseInfo(surface.mesh(), surface.edge(4, 1))), 0);
}

// At the lower end of a crease, corners use the surviving vertex with the most similar normal. The crease runs upwards
// from vertex 4, the centre of the grid: along it, the right column of quads has different normals from the left
// column. Vertex 1, below vertex 4, has a single normal.
TEST(WedgeModule, whereACreaseBeginsCornersTakeTheMostSimilarNormal) {
    for (const bool likeTheRight : {false, true}) {
        Vertices vertices = tornGrid(0);
        vertices.normals.assign(12, {0, 0, 1});
        for (const std::size_t v : {5u, 8u, 10u, 11u}) vertices.normals[v] = {1, 0, 0};
        if (likeTheRight) vertices.normals[1] = glm::normalize(glm::vec3(1, 0, 0.5f));
        DrawnSurface surface(vertices, {together(leftTriangles, {1, 2, 5, 1, 5, 10, 10, 5, 8, 10, 8, 11})});
        EXPECT_EQ(surface.modules().wedges.judge(surface.edge(1, 4)), Fit::good);
        surface.collapse(1, 4);
        EXPECT_EQ(drawnFaces(surface.mesh()),
                  (std::vector<Face>{
                      {0, 4, 3}, {2, 5, likeTheRight ? 10 : 4}, {3, 4, 7}, {3, 7, 6}, {5, 8, 10}, {8, 11, 10}}));
    }
}

// A wedge is a vertex with its attributes. The cost of replacing it by another wedge is summed over its faces: area
// times squared attribute difference. Vertex 5 has three faces. After vertex 4, with six faces, has collapsed onto
// vertex 5, the wedge of vertex 5 stands for 3 + 6 faces, so its cost triples. The two faces at edge 4–5 count twice.
TEST(WedgeModule, theSurvivorsWedgeStandsForTheFacesOfBoth) {
    DrawnSurface surface(grid(), {together(leftTriangles, rightTriangles)});
    const WedgeTable& wedges = surface.mesh().wedges;
    const float before = wedges.cost({5}, {0}, {0, 0, 0});
    ASSERT_GT(before, 0);
    surface.collapse(4, 5);
    EXPECT_NEAR(wedges.cost({5}, {0}, {0, 0, 0}) / before, 3, 1e-4);
    EXPECT_EQ(wedges.cost({4}, {0}, {0, 0, 0}), 0) << "the removed vertex has no cost left";
}

}  // namespace
}  // namespace defocus::engine
