#include "lod/pyramid/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lod/shapes.h"
#include "special_values.h"

namespace defocus::engine {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
Surface surfaceOf(const Mesh& mesh, const glm::vec3& shift = glm::vec3(0)) {
    std::vector<glm::vec3> positions = mesh.vertices.positions;
    for (glm::vec3& p : positions) p += shift;
    return prepareSurface(positions, mesh.primitives.at(0).indices);
}

Surface triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const std::vector<glm::vec3> positions = {a, b, c};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    return prepareSurface(positions, indices);
}

void expectAll(const Distances& distances, double expected, double tolerance) {
    EXPECT_NEAR(distances.mean, expected, tolerance);
    EXPECT_NEAR(distances.percentile99, expected, tolerance);
    EXPECT_NEAR(distances.maximum, expected, tolerance);
}

TEST(SurfaceDistance, ParallelSquaresAreTheirOffsetApartEverywhere) {
    // The result does not depend on how the two squares are triangulated.
    const SurfaceDistance d = surfaceDistance(surfaceOf(flatGrid(7)), surfaceOf(flatGrid(16), {0, 0, 0.125}), 1000);
    expectAll(d.forward, 0.125, 1e-12);
    expectAll(d.backward, 0.125, 1e-12);
    expectAll(d.both, 0.125, 1e-12);
}

TEST(SurfaceDistance, SquareBesideASquareOfTwiceItsWidth) {
    // The square [0, 1]² lies inside the rectangle [0, 2] × [0, 1], so the forward distance is 0. The backward distance
    // is uniform in [0, 1] on the half of the area beyond x = 1: its mean is 1/4 and its 99th percentile 0.98.
    Mesh wide = flatGrid(9);
    for (glm::vec3& p : wide.vertices.positions) p.x *= 2;
    const SurfaceDistance d = surfaceDistance(surfaceOf(flatGrid(12)), surfaceOf(wide), 4096);
    expectAll(d.forward, 0, 1e-6);
    EXPECT_NEAR(d.backward.mean, 0.25, 0.005);
    EXPECT_NEAR(d.backward.percentile99, 0.98, 0.005);
    EXPECT_NEAR(d.backward.maximum, 1, 0.005);
    EXPECT_EQ(d.both.mean, d.backward.mean);
    EXPECT_EQ(d.both.percentile99, d.backward.percentile99);
    EXPECT_EQ(d.both.maximum, d.backward.maximum);
}

TEST(SurfaceDistance, CylinderAgainstItsInscribedPrism) {
    // A side of an n-gon in the unit circle lies cos(π/n) from the centre. At the distance s from the side's midpoint,
    // the side is 1 − √(cos²(π/n) + s²) away from the circle. The max of this distance is the sagitta 1 − cos(π/n), and
    // its mean is two thirds of the sagitta, to second order.
    const auto cylinder = [](std::uint32_t columns) {
        return surfaceOf(parametricSurface(columns, 4, [=](std::uint32_t i, std::uint32_t j) {
            return glm::dvec3(std::cos(turn(i, columns)), std::sin(turn(i, columns)), 0.25 * j);
        }));
    };
    const double sagitta = 1 - std::cos(std::numbers::pi / 12);
    const double ownSagitta = 1 - std::cos(std::numbers::pi / 1536);
    const SurfaceDistance d = surfaceDistance(cylinder(1536), cylinder(12), 20'000);
    for (const Distances& way : {d.forward, d.backward}) {
        EXPECT_NEAR(way.maximum, sagitta, 1e-3 * sagitta + ownSagitta);
        EXPECT_NEAR(way.mean, 2 * sagitta / 3, 0.01 * sagitta + ownSagitta);
        // For 99 % of points spread evenly over a side of the polygon, the distance from the side's midpoint exceeds 1
        // % of half the side. Their distance to the circumscribed circle is at most sagitta·(1 − 0.01²).
        EXPECT_NEAR(way.percentile99, sagitta, 0.005 * sagitta + ownSagitta);
    }
}

TEST(SurfaceDistance, SphereAgainstItsInscribedTessellation) {
    // If a face's plane lies at the distance h from the unit sphere's centre, no point of the face is farther than
    // 1 − h from the sphere. A circumcentre inside the face has exactly this distance.
    const Mesh coarse = sphere(16, 8);
    const auto& p = coarse.vertices.positions;
    const auto& indices = coarse.primitives[0].indices;
    double largest = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a = p[indices[i]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(p[indices[i + 1]]) - a, glm::dvec3(p[indices[i + 2]]) - a);
        largest = std::max(largest, 1 - std::abs(glm::dot(a, glm::normalize(normal))));
    }
    const double finest = 1 - std::cos(std::numbers::pi / 128);  // sagitta of the fine sphere's meridians
    const SurfaceDistance d = surfaceDistance(surfaceOf(sphere(256, 128)), surfaceOf(coarse), 20'000);
    EXPECT_LE(d.both.maximum, largest + 1e-6);
    EXPECT_NEAR(d.both.maximum, largest, 0.02 * largest + 2 * finest);
    EXPECT_LE(d.both.percentile99, d.both.maximum);
    EXPECT_LT(d.both.mean, d.both.percentile99);
}

TEST(SurfaceDistance, SurfaceIsNowhereApartFromItself) {
    const Surface bumpy = surfaceOf(sphere(48, 24, 0.1));
    expectAll(surfaceDistance(bumpy, bumpy, 5000).both, 0, 1e-9);
    Mesh cube;  // a cube with 2 triangles per side, without shared vertices
    cube.primitives.resize(1);
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {0.0f, 1.0f})
            for (const bool upper : {false, true})
                for (int corner = 0; corner < 3; ++corner) {
                    glm::vec3 q(0);
                    q[axis] = side;
                    q[(axis + 1) % 3] = corner == 1 || upper ? 1.0f : 0.0f;
                    q[(axis + 2) % 3] = corner == 2 || (upper && corner != 1) ? 1.0f : 0.0f;
                    if (upper && corner == 1) q[(axis + 2) % 3] = 0.0f;
                    if (upper && corner == 2) q[(axis + 1) % 3] = 0.0f;
                    cube.primitives[0].indices.push_back(static_cast<std::uint32_t>(cube.vertices.count()));
                    cube.vertices.positions.push_back(q);
                }
    const Surface box = surfaceOf(cube);
    EXPECT_DOUBLE_EQ(box.areas.back(), 6);
    expectAll(surfaceDistance(box, box, 5000).both, 0, 1e-12);
}

TEST(SurfaceDistance, ShiftedTriangle) {
    // The triangle is shifted twice: first by 2 along its normal, then by (−1, 0) in its plane. After the second shift,
    // only points left of x = 0 lie outside the original triangle.
    const Surface still = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    expectAll(surfaceDistance(still, triangle({0, 0, 2}, {4, 0, 2}, {0, 4, 2}), 500).both, 2, 1e-12);
    const SurfaceDistance d = surfaceDistance(triangle({-1, 0, 0}, {3, 0, 0}, {-1, 4, 0}), still, 4096);
    // The forward distance is −x on the strip x < 0. Its mean is ∫₀¹ t·(3 + t) dt, divided by the triangle's area of 8.
    EXPECT_NEAR(d.forward.mean, (1.5 + 1.0 / 3) / 8, 0.01);
    EXPECT_NEAR(d.forward.maximum, 1, 0.03);
    // The corner (4, 0) has the max backward distance: 1, to the corner (3, 0). Its closest point on the line x + y = 3
    // is nearer but lies beyond the end of the edge on this line.
    EXPECT_LE(d.backward.maximum, 1);
    EXPECT_NEAR(d.backward.maximum, 1, 0.06);
}

TEST(SurfaceDistance, ClosestPointIsFoundAmongAll) {
    // The search tree agrees with a linear search through all triangles for points near, far and inside the surface.
    const Mesh mesh = torus(24, 12);
    const Surface surface = surfaceOf(mesh);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p(2 * std::sin(1.1 * i), 2 * std::sin(1.7 * i + 1), std::sin(2.3 * i + 2));
        double min = infinity;
        const auto& indices = mesh.primitives[0].indices;
        for (std::size_t t = 0; t < indices.size(); t += 3)
            min = std::min(
                min, distanceTo(triangle(mesh.vertices.positions[indices[t]], mesh.vertices.positions[indices[t + 1]],
                                         mesh.vertices.positions[indices[t + 2]]),
                                p));
        ASSERT_DOUBLE_EQ(distanceTo(surface, p), min) << i;
        // The distance to a torus is | |(√(x² + y²) − 1, z)| − 0.4 |. The mesh's faces lie inside the torus by at most
        // the sum of two sagittas: of the polygons around the torus and around its tube.
        const double exact = std::abs(std::hypot(std::hypot(p.x, p.y) - 1, p.z) - 0.4);
        ASSERT_NEAR(min, exact,
                    1.4 * (1 - std::cos(std::numbers::pi / 24)) + 0.4 * (1 - std::cos(std::numbers::pi / 12)))
            << i;
    }
}

TEST(SurfaceDistance, PointsAreSpreadByArea) {
    // The surface has one triangle of area 3 at distance 1, and 300 triangles with a total area of 1 at distance 5.
    std::vector<glm::vec3> positions = {{0, 0, 1}, {3, 0, 1}, {0, 2, 1}};
    for (int i = 0; i < 300; ++i) {
        const float x = 0.005f * static_cast<float>(i);
        positions.insert(positions.end(), {{x, 0, 5}, {x + 1.0f / 150, 0, 5}, {x, 1, 5}});
    }
    std::vector<std::uint32_t> indices(positions.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    const Surface ground = triangle({-9, -9, 0}, {20, -9, 0}, {-9, 20, 0});
    EXPECT_NEAR(surfaceDistance(prepareSurface(positions, indices), ground, 1000).forward.mean, 2, 0.01);
}

TEST(SurfaceDistance, TrianglesWithoutPlaceOrAreaAreLeftOut) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {9, 9, 9}, {5, 0, 0}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 1, 3, 4, 4, 4, 0, 1, 5, 0, 4, 4, 1, 2};
    const Surface surface = prepareSurface(positions, indices);
    ASSERT_EQ(surface.triangles.size(), 1u);
    EXPECT_DOUBLE_EQ(surface.areas.back(), 0.5);
    EXPECT_DOUBLE_EQ(distanceTo(surface, {9, 0, 0}), 8);
}

TEST(SurfaceDistance, EmptySurfaceIsInfinitelyFar) {
    const Surface none = prepareSurface({}, {});
    const Surface some = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(distanceTo(none, {0, 0, 0}), infinity);
    expectAll(surfaceDistance(none, none, 100).both, 0, 0);
    const SurfaceDistance d = surfaceDistance(some, none, 100);
    EXPECT_EQ(d.forward.mean, infinity);
    EXPECT_EQ(d.backward.maximum, 0);
    EXPECT_EQ(d.both.percentile99, infinity);
}

TEST(SurfaceDistance, NoPointsMeasureNothing) {
    const Surface some = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    expectAll(surfaceDistance(some, some, 0).both, 0, 0);
}

TEST(SurfaceDistance, OnePointStandsForAll) {
    const Surface some = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    expectAll(surfaceDistance(some, triangle({0, 0, 3}, {1, 0, 3}, {0, 1, 3}), 1).both, 3, 1e-12);
}

}  // namespace
}  // namespace defocus::engine
