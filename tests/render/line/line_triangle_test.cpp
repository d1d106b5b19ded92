// Tests the intervals of a lens line, which is a line across the lens, from which a triangle is visible. At points of
// the line, the ray's intersection with the triangle's plane is the reference.

#include "render/line/line_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

namespace defocus::engine {
namespace {

constexpr double nearPlane = 0.1;

// Returns whether the triangle is hit by the ray from the lens point p·d through the image position `line.place`, with
// d = `line.direction`. Returns nullopt if the ray passes so close to an edge that rounding decides.
std::optional<bool> met(const std::array<LensVertex, 3>& corners, const LensLine& line, double p, bool front) {
    glm::dmat3 matrix(0);
    for (int i = 0; i < 3; ++i) {
        const LensVertex& v = corners[static_cast<std::size_t>(i)];
        matrix[i] = {v.x + v.c * p * line.direction.x, v.y + v.c * p * line.direction.y, v.w};
    }
    const double determinant = glm::determinant(matrix);
    if (std::abs(determinant) < 1e-9) return {};
    // barycentric coordinates divided by the depth w
    const glm::dvec3 weights = glm::inverse(matrix) * glm::dvec3(line.place, 1);
    const double w = 1 / (weights.x + weights.y + weights.z);
    const glm::dvec3 barycentric = w * weights;
    const double margin = 1e-6;
    const double min = std::min({barycentric.x, barycentric.y, barycentric.z});
    if (std::abs(min) < margin || std::abs(w - nearPlane) < margin) return {};
    return min > 0 && w > nearPlane && (determinant > 0) == front;
}

LensVertex vertexAt(double x, double y, double w) {
    constexpr double a = -0.4, focus = 3;  // coefficients of the circle of confusion C = a·(1 − w/focus) at depth w
    return {x, y, w, a * (1 - w / focus)};
}

LensLine lineAt(double angle, const glm::dvec2& place) {
    return {{std::cos(angle), 1.5 * std::sin(angle)}, place, nearPlane, -1, 1};
}

struct Depths {
    const char* name;
    double min;
    double max;
};

class LineTriangles : public testing::TestWithParam<Depths> {};

TEST_P(LineTriangles, coverTheLineWhereTheirPointsDo) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> depth(GetParam().min, GetParam().max), side(-1.5, 1.5), unit(0, 1);
    int compared = 0, seenPoints = 0, backs = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        std::array<LensVertex, 3> corners;
        for (LensVertex& corner : corners) {
            const double w = depth(random);
            corner = vertexAt(side(random) * std::max(std::abs(w), 0.3), side(random) * std::max(std::abs(w), 0.3), w);
        }
        const LensLine line = lineAt(std::numbers::pi * unit(random), {unit(random) - 0.5, unit(random) - 0.5});
        const std::vector<LineInterval> seen = seenOnLine(corners, line, true);
        for (const bool front : {true, false})
            for (double p = -0.99; p < 1; p += 0.0457) {
                const std::optional<bool> expected = met(corners, line, p, front);
                if (!expected) continue;
                bool covered = false;
                for (const LineInterval& interval : seen)
                    covered |= interval.front == front && p >= interval.first && p <= interval.last;
                ASSERT_EQ(covered, *expected) << GetParam().name << " trial " << trial << " p " << p;
                ++compared;
                seenPoints += covered ? 1 : 0;
                backs += covered && !front ? 1 : 0;
            }
    }
    EXPECT_GT(compared, 300000);
    EXPECT_GT(seenPoints, 5000);
    EXPECT_GT(backs, 2000);
}

INSTANTIATE_TEST_SUITE_P(Depths, LineTriangles,
                         testing::Values(Depths{"inFront", 0.5, 2.5}, Depths{"behind", 3.5, 9}, Depths{"across", 1, 8},
                                         Depths{"throughTheNearPlane", -2, 5}),
                         [](const auto& tested) { return tested.param.name; });

TEST(LineTriangle, inTheFocusPlaneIsSeenFromAllOfTheLensOrNone) {
    const std::array<LensVertex, 3> corners = {vertexAt(-1, -1, 3), vertexAt(1, -1, 3), vertexAt(0, 1, 3)};
    const std::vector<LineInterval> inside = seenOnLine(corners, lineAt(0.7, {0, 0}), false);
    ASSERT_EQ(inside.size(), 1u);
    EXPECT_EQ(inside[0].first, -1);
    EXPECT_EQ(inside[0].last, 1);
    EXPECT_TRUE(seenOnLine(corners, lineAt(0.7, {0.5, 0}), true).empty());
}

TEST(LineTriangle, withoutAreaIsNeverSeen) {
    const std::array<LensVertex, 3> point = {vertexAt(0, 0, 5), vertexAt(0, 0, 5), vertexAt(0, 0, 5)};
    const std::array<LensVertex, 3> edge = {vertexAt(-1, 0.1, 5), vertexAt(1, 0.1, 5), vertexAt(1, 0.1, 5)};
    for (const double angle : {0.0, 0.4, std::numbers::pi / 2}) {
        EXPECT_TRUE(seenOnLine(edge, lineAt(angle, {0.013, 0.017}), true).empty()) << angle;
        EXPECT_TRUE(seenOnLine(point, lineAt(angle, {0.013, 0.017}), true).empty()) << angle;
    }
}

TEST(LineTriangle, facingAwayIsSeenOnlyIfItHasTwoSides) {
    const std::array<LensVertex, 3> corners = {vertexAt(-3, -3, 5), vertexAt(0, 3, 5), vertexAt(3, -3, 5)};
    EXPECT_TRUE(seenOnLine(corners, lineAt(0.3, {0, 0}), false).empty());
    const std::vector<LineInterval> both = seenOnLine(corners, lineAt(0.3, {0, 0}), true);
    ASSERT_EQ(both.size(), 1u);
    EXPECT_FALSE(both[0].front);
}

}  // namespace
}  // namespace defocus::engine
