#include "lod/simplify/manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lod/numbered.h"

namespace defocus::engine {
namespace {

using Points = Numbered<PositionNumber, glm::dvec3>;

Manifold manifoldOf(const Points& points, const std::vector<std::uint32_t>& corners) {
    return buildManifold(numberedTriangles<PositionNumber>({corners}), points);
}

std::ptrdiff_t pairedHalfEdges(const Manifold& manifold) {
    return std::count_if(manifold.twins.begin(), manifold.twins.end(),
                         [](SurfaceCorner twin) { return twin.isValid(); });
}

// Expects twin half-edges to refer to each other and to join the same two vertices.
void expectConsistent(const Manifold& manifold) {
    const auto end = [&](SurfaceCorner e) { return manifold.corners[{e.value % 3 == 2 ? e.value - 2 : e.value + 1}]; };
    for (const SurfaceCorner e : manifold.twins.numbers()) {
        const SurfaceCorner twin = manifold.twins[e];
        if (!twin.isValid()) continue;
        EXPECT_EQ(manifold.twins[twin], e);
        EXPECT_EQ(std::minmax({manifold.corners[e], end(e)}), std::minmax({manifold.corners[twin], end(twin)}));
    }
}

const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Manifold, TetrahedronIsClosed) {
    const Manifold manifold =
        manifoldOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 12);
    EXPECT_EQ(manifold.positions.size(), 4u);
    EXPECT_EQ(manifold.repairs.faces, 0u);
}

// The two triangles of a square share the diagonal.
//
// 3---2
// | / |
// 0---1
TEST(Manifold, SquareHasOneInnerEdge) {
    const Manifold manifold = manifoldOf(square, {0, 1, 2, 0, 2, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 2);
    EXPECT_EQ(manifold.positions.size(), 4u);
    EXPECT_EQ(manifold.repairs.faces, 0u);
}

TEST(Manifold, FaceWoundAgainstItsNeighboursIsTurned) {
    // In a strip of three faces, the middle face is reversed: the first face is 0 1 2, the second is 1 2 3 with the
    // wrong winding, and the third is 2 3 4.
    const Points strip = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}};
    const Manifold manifold = manifoldOf(strip, {0, 2, 1, 1, 3, 2, 2, 4, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 4);
    EXPECT_EQ(manifold.turned, (Numbered<SurfaceFaceNumber, std::uint8_t>{0, 1, 0}));
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.turned, 1u);
}

TEST(Manifold, BowTieGetsTwoVerticesAtItsKnot) {
    // Two triangles share only vertex 2, in the middle:
    //
    // 1   4
    // | X |
    // 0   3
    const Points points = {{0, 0, 0}, {0, 2, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}};
    const Manifold manifold = manifoldOf(points, {0, 2, 1, 3, 4, 2});
    EXPECT_EQ(manifold.positions.size(), 6u);
    EXPECT_EQ(std::count(manifold.positions.begin(), manifold.positions.end(), PositionNumber{2}), 2);
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.split, 1u);
}

TEST(Manifold, ThirdFaceOfAnEdgeIsCutOffWhereTheOthersContinueEachOther) {
    // A flat square 0 1 2 3 has the diagonal 0–2, and a third face 0 2 4 stands on the diagonal.
    Points points = square;
    points.push_back({0.5, 0.5, 1});
    const Manifold manifold = manifoldOf(points, {0, 1, 2, 0, 2, 4, 0, 2, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 2);
    EXPECT_EQ(manifold.twins[{2}], SurfaceCorner{6});  // edge 2→0 of the first face, and edge 0→2 of the last face
    EXPECT_EQ(manifold.positions.size(), 7u);
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.cut, 1u);
}

TEST(Manifold, SheetWithTwoFacesClosesAroundItsOutline) {
    // The faces of the square and their reversed copies form a two-sided sheet. Across the diagonal, faces join faces
    // of the same side; at the four outer edges, each face joins its reversed copy.
    const Manifold manifold = manifoldOf(square, {0, 1, 2, 0, 2, 1, 0, 2, 3, 0, 3, 2});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 12);
    EXPECT_EQ(manifold.twins[{2}], SurfaceCorner{6});
    EXPECT_EQ(manifold.positions.size(), 4u);
    EXPECT_EQ(manifold.repairs.faces, 0u);
}

TEST(Manifold, DegenerateAndRepeatedFacesHaveNoPlaceInASurface) {
    const Manifold manifold = manifoldOf(square, {0, 1, 2, 1, 2, 0, 0, 0, 1, 3, 3, 3, 0, 2, 3});
    EXPECT_EQ(manifold.faces, (numbered<Numbered<SurfaceFaceNumber, TriangleNumber>>({0, 4})));
    EXPECT_EQ(manifold.repairs.faces, 3u);
    EXPECT_EQ(manifold.repairs.dropped, 3u);
    EXPECT_EQ(manifold.positions.size(), 4u);
}

TEST(Manifold, SameFaceInTwoPrimitivesStays) {
    const Manifold manifold = buildManifold(numberedTriangles<PositionNumber>({{0, 1, 2}, {0, 1, 2}}), square);
    EXPECT_EQ(manifold.faces.size(), 2u);
    EXPECT_EQ(manifold.positions.size(), 6u);
}

TEST(Manifold, MoebiusBandIsCutAtOneEdge) {
    // Five triangles i, i+1, i+2 (mod 5) form a Möbius strip: the edges i, i+1 have two faces each, and the edges i,
    // i+2 form the strip's single border.
    Points points;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < 5; ++i) {
        points.push_back({std::cos(1.2566 * i), std::sin(1.2566 * i), 0.1 * i});
        corners.insert(corners.end(), {i, (i + 1) % 5, (i + 2) % 5});
    }
    const Manifold manifold = manifoldOf(points, corners);
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 8);
    EXPECT_GT(manifold.repairs.faces, 0u);
}

TEST(Manifold, HundredFacesAtOneEdgeAreCutApart) {
    Points points = {{0, 0, 0}, {0, 0, 1}};
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < 100; ++i) {
        points.push_back({std::cos(0.0628 * i), std::sin(0.0628 * i), 0.5});
        corners.insert(corners.end(), {0, 1, i + 2});
    }
    const Manifold manifold = manifoldOf(points, corners);
    EXPECT_EQ(manifold.faces.size(), 100u);
    EXPECT_EQ(pairedHalfEdges(manifold), 0);
    EXPECT_EQ(manifold.positions.size(), 300u);
}

}  // namespace
}  // namespace defocus::engine
