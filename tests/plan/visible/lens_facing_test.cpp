// Tests bounds on the determinant whose sign says whether a triangle faces a lens point (Munkberg, Toth and
// Akenine-Möller 2012, Appendix A). Sampled values over lens and time must not exceed the bounds.

#include "plan/visible/lens_facing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace defocus::engine {
namespace {

constexpr double aspect = 1.5;

class TriangleSource {
public:
    explicit TriangleSource(std::uint32_t seed) : engine_(seed) {}
    double operator()(double min, double max) { return std::uniform_real_distribution<double>(min, max)(engine_); }

private:
    std::mt19937 engine_;
};

LensTriangle anyTriangle(TriangleSource& random) {
    LensTriangle triangle;
    const double depth = random(0.5, 5);
    for (std::size_t i = 0; i < 3; ++i) {
        triangle.places[i] = {random(-1, 1), random(-1, 1), depth + random(0, 1)};
        triangle.coc[i] = random(-0.3, 0.3);
    }
    return triangle;
}

// Returns the determinant of the triangle after its corners are sheared for the lens point (u, v).
double sheared(const LensTriangle& triangle, double u, double v) {
    glm::dvec3 q[3];
    for (std::size_t i = 0; i < 3; ++i) q[i] = triangle.places[i] + triangle.coc[i] * glm::dvec3(u, aspect * v, 0);
    return glm::dot(q[0], glm::cross(q[1], q[2]));
}

// Returns the max of the triangle's facing determinant over the lens, by sampling. The max lies on the rim because the
// determinant is linear over the lens.
double sampledLargest(const LensTriangle& triangle, double radius) {
    double largest = sheared(triangle, 0, 0);
    constexpr int points = 720;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        largest = std::max(largest, sheared(triangle, radius * std::cos(angle), radius * std::sin(angle)));
    }
    return largest;
}

// Returns the max change of the facing determinant from the lens centre to the rim. This is the unit for errors of the
// bounds.
double spreadOf(const LensTriangle& triangle) {
    return sampledLargest(triangle, 1) - sheared(triangle, 0, 0);
}

TEST(LensFacing, isTheLargestOverTheLensForAnyC) {
    TriangleSource random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const LensTriangle triangle = anyTriangle(random);
        const double radius = random(0.2, 1);
        const double bound = largestDeterminant(triangle, aspect, radius);
        const double sampled = sampledLargest(triangle, radius);
        const double slack = 1e-12 * (1 + std::abs(bound));
        EXPECT_GE(bound, sampled - slack);
        EXPECT_LE(bound, sampled + 1e-4 * spreadOf(triangle) + slack) << "Eq. 5 is exact";
    }
}

// For a thin lens, whose circle of confusion C = a + b·w is linear in the depth w, the bound on the facing determinant
// equals the bound for an eye that moves over a disk of radius |a| (Munkberg et al. 2012, Eq. 6).
TEST(LensFacing, ofAThinLensIsThePublishedShortForm) {
    TriangleSource random(2);
    const double a = -0.12, b = 0.05;
    for (int trial = 0; trial < 500; ++trial) {
        LensTriangle t = anyTriangle(random);
        for (std::size_t i = 0; i < 3; ++i) t.coc[i] = a + b * t.places[i].z;
        const glm::dvec3 n = glm::cross(t.places[0], t.places[1]) + glm::cross(t.places[1], t.places[2]) +
                             glm::cross(t.places[2], t.places[0]);
        const double det = glm::dot(t.places[0], glm::cross(t.places[1], t.places[2]));
        EXPECT_NEAR(largestDeterminant(t, aspect), det + std::abs(a) * std::hypot(n.x, aspect * n.y), 1e-12);
    }
}

double sampledLargest(const LensTriangle& from, const LensTriangle& to) {
    double largest = -1e300;
    for (int step = 0; step <= 40; ++step)
        largest = std::max(largest, sampledLargest(between(from, to, step / 40.0), 1));
    return largest;
}

// The bound on the facing determinant over lens and time (Munkberg et al. 2012, Eq. 7 and 8) holds for moving
// triangles.
TEST(LensFacing, boundsTheLargestOverLensAndTime) {
    TriangleSource random(3);
    double loosest = 0;
    double loosestDivided = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const LensTriangle from = anyTriangle(random);
        LensTriangle to = anyTriangle(random);
        // The triangle's motion ranges from almost none to a change into an unrelated triangle.
        const double share = std::pow(10.0, random(-3, 0));
        to = between(from, to, share);
        const double sampled = sampledLargest(from, to);
        const double bound = largestDeterminant(from, to, aspect);
        ASSERT_GE(bound, sampled - 1e-9);
        // Dividing the exposure into eight parts tightens the bound: its error shrinks with the square of a part's
        // length.
        double divided = -1e300;
        for (int part = 0; part < 8; ++part)
            divided = std::max(divided, largestDeterminant(between(from, to, part / 8.0),
                                                           between(from, to, (part + 1) / 8.0), aspect));
        ASSERT_GE(divided, sampled - 1e-9);
        ASSERT_LE(divided, bound + 1e-9);
        const double size = std::max(spreadOf(from), spreadOf(to));
        loosest = std::max(loosest, (bound - sampled) / size);
        loosestDivided = std::max(loosestDivided, (divided - sampled) / size);
    }
    EXPECT_GT(loosest, 0.1) << "some triangles move far";
    EXPECT_LT(loosestDivided, 0.1 * loosest + 0.01);
}

TEST(LensFacing, isExactOfWhatStandsStillAndWhereOnlyTheBlurChanges) {
    TriangleSource random(4);
    for (int trial = 0; trial < 500; ++trial) {
        const LensTriangle from = anyTriangle(random);
        EXPECT_NEAR(largestDeterminant(from, from, aspect), largestDeterminant(from, aspect), 1e-12);
        LensTriangle to = from;
        for (double& coc : to.coc) coc = random(-0.3, 0.3);
        const double ends = std::max(largestDeterminant(from, aspect), largestDeterminant(to, aspect));
        EXPECT_NEAR(largestDeterminant(from, to, aspect), ends, 1e-12) << "|N| is convex in time";
    }
}

}  // namespace
}  // namespace defocus::engine
