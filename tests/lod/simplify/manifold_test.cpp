#include "lod/simplify/manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace defocus {
namespace {

constexpr std::uint32_t none = Manifold::none;

Manifold manifoldOf(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& corners) {
    return buildManifold({corners, {static_cast<std::uint32_t>(corners.size())}}, points);
}

std::ptrdiff_t pairedHalfEdges(const Manifold& manifold) {
    return std::count_if(manifold.twins.begin(), manifold.twins.end(), [](std::uint32_t twin) { return twin != none; });
}

// Twins name each other and join the same two vertices.
void expectConsistent(const Manifold& manifold) {
    const auto end = [&](std::uint32_t e) { return manifold.corners[e % 3 == 2 ? e - 2 : e + 1]; };
    for (std::uint32_t e = 0; e < manifold.twins.size(); ++e) {
        const std::uint32_t twin = manifold.twins[e];
        if (twin == none) continue;
        EXPECT_EQ(manifold.twins[twin], e);
        EXPECT_EQ(std::minmax({manifold.corners[e], end(e)}), std::minmax({manifold.corners[twin], end(twin)}));
    }
}

const std::vector<glm::dvec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Manifold, TetrahedronIsClosed) {
    const Manifold manifold =
        manifoldOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 12);
    EXPECT_EQ(manifold.positions.size(), 4u);
    EXPECT_EQ(manifold.repairs.faces, 0u);
}

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
    // The middle one of a strip of three: 0 1 2, then 1 2 3 the wrong way, then 2 3 4.
    const std::vector<glm::dvec3> strip = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}};
    const Manifold manifold = manifoldOf(strip, {0, 2, 1, 1, 3, 2, 2, 4, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 4);
    EXPECT_EQ(manifold.turned, (std::vector<std::uint8_t>{0, 1, 0}));
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.turned, 1u);
}

TEST(Manifold, BowTieGetsTwoVerticesAtItsKnot) {
    // 1   4
    // | X |   with the knot 2 in the middle
    // 0   3
    const std::vector<glm::dvec3> points = {{0, 0, 0}, {0, 2, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}};
    const Manifold manifold = manifoldOf(points, {0, 2, 1, 3, 4, 2});
    EXPECT_EQ(manifold.positions.size(), 6u);
    EXPECT_EQ(std::count(manifold.positions.begin(), manifold.positions.end(), 2u), 2);
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.split, 1u);
}

TEST(Manifold, ThirdFaceOfAnEdgeIsCutOffWhereTheOthersContinueEachOther) {
    // A flat square 0 1 2 3 over the diagonal 0-2, and a fin 0 2 4 standing on the diagonal.
    std::vector<glm::dvec3> points = square;
    points.push_back({0.5, 0.5, 1});
    const Manifold manifold = manifoldOf(points, {0, 1, 2, 0, 2, 4, 0, 2, 3});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 2);
    EXPECT_EQ(manifold.twins[2], 6u);  // 2→0 of the first face, 0→2 of the last
    EXPECT_EQ(manifold.positions.size(), 7u);
    EXPECT_EQ(manifold.repairs.faces, 1u);
    EXPECT_EQ(manifold.repairs.cut, 1u);
}

TEST(Manifold, SheetWithTwoFacesClosesAroundItsOutline) {
    // The square and its reverse: fronts continue fronts over the diagonal, fronts and backs meet at the four outer
    // edges.
    const Manifold manifold = manifoldOf(square, {0, 1, 2, 0, 2, 1, 0, 2, 3, 0, 3, 2});
    expectConsistent(manifold);
    EXPECT_EQ(pairedHalfEdges(manifold), 12);
    EXPECT_EQ(manifold.twins[2], 6u);
    EXPECT_EQ(manifold.positions.size(), 4u);
    EXPECT_EQ(manifold.repairs.faces, 0u);
}

TEST(Manifold, DegenerateAndRepeatedFacesHaveNoPlaceInASurface) {
    const Manifold manifold = manifoldOf(square, {0, 1, 2, 1, 2, 0, 0, 0, 1, 3, 3, 3, 0, 2, 3});
    EXPECT_EQ(manifold.faces, (std::vector<std::uint32_t>{0, 4}));
    EXPECT_EQ(manifold.repairs.faces, 3u);
    EXPECT_EQ(manifold.repairs.dropped, 3u);
    EXPECT_EQ(manifold.positions.size(), 4u);
}

TEST(Manifold, SameFaceInTwoPrimitivesStays) {
    const Manifold manifold = buildManifold({{0, 1, 2, 0, 1, 2}, {3, 3}}, square);
    EXPECT_EQ(manifold.faces.size(), 2u);
    EXPECT_EQ(manifold.positions.size(), 6u);
}

TEST(Manifold, MoebiusBandIsCutAtOneEdge) {
    // Five triangles i, i+1, i+2 (mod 5): the edges i, i+1 have two faces each, the edges i, i+2 are its single border.
    std::vector<glm::dvec3> points;
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
    std::vector<glm::dvec3> points = {{0, 0, 0}, {0, 0, 1}};
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
}  // namespace defocus
