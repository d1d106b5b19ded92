#include "lod/simplify/level_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lod/simplify/smoothing_groups.h"

namespace defocus {
namespace {

const glm::vec3 up(0, 0, 1);
const glm::vec3 right(1, 0, 0);

TEST(SmoothingGroups, joinNormalsWithinADegreeAtOnePositionOnly) {
    const glm::vec3 almostUp = glm::normalize(glm::vec3(0.01f, 0, 1));  // 0.57°
    const std::vector<std::uint32_t> groups = smoothingGroups({up, right, almostUp, up}, {0, 0, 0, 1});
    EXPECT_EQ(groups[0], groups[2]);
    EXPECT_NE(groups[0], groups[1]);
    EXPECT_NE(groups[0], groups[3]);
}

// One triangle (vertices 0, 1, 2 of the level) stands for 3 + `inner` vertices at the barycentric places below.
struct OneTriangle {
    Vertices vertices;
    std::vector<Anchor> anchors;
};

OneTriangle oneTriangle() {
    OneTriangle result;
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; i + j <= 10; ++j) {
            const bool corner = i == 10 || j == 10 || i + j == 0;
            if (corner) continue;
            Anchor anchor{0, {0.1f * float(i), 0.1f * float(j), 1 - 0.1f * float(i + j)}};
            result.anchors.push_back(anchor);
        }
    std::vector<Anchor> corners = {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}};
    result.anchors.insert(result.anchors.begin(), corners.begin(), corners.end());
    const glm::vec3 corner[3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
    for (const Anchor& anchor : result.anchors) {
        glm::vec3 position(0);
        for (int k = 0; k < 3; ++k) position += anchor.weight[k] * corner[k];
        result.vertices.positions.push_back(position);
        result.vertices.normals.push_back(up);
        result.vertices.colors.emplace_back(0, 0, 0, 255);
    }
    return result;
}

// The level is the triangle, and as many more of the vertices behind it as `indices` name.
defocus::LevelFit fitOf(const OneTriangle& t, const std::vector<std::uint32_t>& indices = {0, 1, 2}) {
    const Welded positions = weldPositions(t.vertices.positions);
    const auto smoothing = smoothingGroups(t.vertices.normals, positions.id);
    FitSource source = prepareFit(t.vertices, positions, smoothing, indices);
    source.areas.assign(t.anchors.size(), 1);  // level 0's triangles are nowhere written down: all alike
    source.bounds.extend({0, 0, 1});
    LevelMesh level;
    level.triangles.indices = indices;
    for (std::uint32_t v = 0; v < indices.size(); ++v) level.sources.push_back(v);
    level.apart.assign(indices.size(), 0);
    return fitLevel(source, level, t.anchors);
}

TEST(LevelFit, flatTriangleStaysWhereItIs) {
    const OneTriangle t = oneTriangle();
    const defocus::LevelFit fitted = fitOf(t);
    for (std::size_t v = 0; v < 3; ++v)
        EXPECT_NEAR(glm::distance(fitted.positions[v], t.vertices.positions[v]), 0, 1e-6);
}

// All but the corners lie 0.3 above the triangle: least squares takes it nearly all the way up.
TEST(LevelFit, triangleRisesToTheBulgeItStandsFor) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 3; v < t.vertices.positions.size(); ++v) t.vertices.positions[v].z = 0.3f;
    const defocus::LevelFit fitted = fitOf(t);
    const float mean = (fitted.positions[0].z + fitted.positions[1].z + fitted.positions[2].z) / 3;
    EXPECT_GT(mean, 0.25f);
    EXPECT_LT(mean, 0.3f);
}

TEST(LevelFit, farFromTheOriginNothingIsLost) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.positions.size(); ++v) {
        t.vertices.positions[v] += glm::vec3(4096, -4096, 0);  // floats are 0.0005 apart there
        if (v >= 3) t.vertices.positions[v].z = 0.3f;
    }
    const defocus::LevelFit fitted = fitOf(t);
    EXPECT_GT((fitted.positions[0].z + fitted.positions[1].z + fitted.positions[2].z) / 3, 0.25f);
    for (std::size_t v = 0; v < 3; ++v)
        EXPECT_NEAR(glm::distance(glm::vec2(fitted.positions[v]), glm::vec2(t.vertices.positions[v])), 0, 0.01);
}

TEST(LevelFit, colourThatIsLinearOverTheTriangleIsKept) {
    OneTriangle t = oneTriangle();
    const float corner[3] = {40, 120, 220};
    for (std::size_t v = 0; v < t.anchors.size(); ++v) {
        float value = 0;
        for (int k = 0; k < 3; ++k) value += t.anchors[v].weight[k] * corner[k];
        t.vertices.colors[v].r = static_cast<std::uint8_t>(std::lround(value));
    }
    const defocus::LevelFit fitted = fitOf(t);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_NEAR(fitted.colors[v].r, corner[v], 4);
    EXPECT_EQ(fitted.colors[0].a, 255);
}

// A survivor that happens to sit on a dark spot must not make the whole triangle dark.
TEST(LevelFit, colourOfOneSpotIsOutvoted) {
    OneTriangle t = oneTriangle();
    for (auto& color : t.vertices.colors) color.r = 200;
    t.vertices.colors[0].r = 0;
    EXPECT_GT(fitOf(t).colors[0].r, 120);
}

TEST(LevelFit, normalsOfAReliefAveragedGetShorter) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.normals.size(); ++v)
        t.vertices.normals[v] = glm::normalize(glm::vec3(v % 2 == 0 ? 0.5f : -0.5f, 0, 1));
    const defocus::LevelFit fitted = fitOf(t);
    glm::vec3 mean(0);
    for (std::size_t v = 0; v < 3; ++v) mean += fitted.normals[v] / 3.0f;
    EXPECT_NEAR(mean.z, 1 / std::sqrt(1.25), 0.01);  // the mean of the two slopes points up and is that long
    EXPECT_NEAR(mean.x, 0, 0.1);
}

TEST(LevelFit, equalNormalsStayUnitLength) {
    const OneTriangle t = oneTriangle();
    for (const glm::vec3& normal : fitOf(t).normals) EXPECT_NEAR(glm::distance(normal, up), 0, 1e-5);
}

TEST(LevelFit, verticesThatNobodyNamesKeepTheirOwn) {
    OneTriangle t = oneTriangle();
    t.vertices.colors[4] = {9, 8, 7, 6};
    t.vertices.normals[4] = right;
    t.vertices.positions[4] = {2, 3, 0};
    const defocus::LevelFit fitted = fitOf(t, {0, 1, 2, 3, 4, 5});
    EXPECT_EQ(fitted.positions[4], t.vertices.positions[4]);
    EXPECT_EQ(fitted.colors[4], t.vertices.colors[4]);
    EXPECT_EQ(fitted.normals[4], right);
}

// Two vertices at one place with one normal: one of them a twin, which only its own anchors move.
TEST(LevelFit, aTwinHasANormalOfItsOwn) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.normals.size(); ++v)
        t.vertices.normals[v] = glm::normalize(glm::vec3(0.2f, 0, 1));
    for (std::size_t v = 0; v < 3; ++v) t.vertices.normals[v] = up;
    const Welded positions = weldPositions(t.vertices.positions);
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    const auto smoothing = smoothingGroups(t.vertices.normals, positions.id);
    FitSource source = prepareFit(t.vertices, positions, smoothing, indices);
    source.areas.assign(t.anchors.size(), 1);
    const LevelMesh level{{{0, 1, 2, 3, 1, 2}, {6}}, {0, 1, 2, 0}, {0, 0, 0, 1}};
    const defocus::LevelFit fitted = fitLevel(source, level, t.anchors);
    EXPECT_EQ(fitted.positions[3], fitted.positions[0]);
    EXPECT_GT(fitted.normals[0].x, 0.05f);
    EXPECT_EQ(fitted.normals[3], up);
}

}  // namespace
}  // namespace defocus
