#include "lod/simplify/level_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lod/numbered.h"

namespace defocus::engine {
namespace {

const glm::vec3 up(0, 0, 1);
const glm::vec3 right(1, 0, 0);

TEST(SmoothingGroups, joinNormalsWithinADegreeAtOnePositionOnly) {
    const glm::vec3 almostUp = glm::normalize(glm::vec3(0.01f, 0, 1));  // direction 0.57° away from +z
    const WeldedPositions positions = weldPositions({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
    const VertexGroups groups = smoothingGroups({up, right, almostUp, up}, positions);
    EXPECT_EQ(groups[{0}], groups[{2}]);
    EXPECT_NE(groups[{0}], groups[{1}]);
    EXPECT_NE(groups[{0}], groups[{3}]);
}

// Vertices of level 0, and their anchors in a coarse level that is a single triangle with the corners 0, 1 and 2. An
// anchor is a point of that triangle, given by barycentric coordinates.
struct OneTriangle {
    Vertices vertices;
    Numbered<MeshVertexNumber, Anchor> anchors;
};

OneTriangle oneTriangle() {
    OneTriangle result;
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; i + j <= 10; ++j) {
            const bool corner = i == 10 || j == 10 || i + j == 0;
            if (corner) continue;
            Anchor anchor{{0}, {0.1f * float(i), 0.1f * float(j), 1 - 0.1f * float(i + j)}};
            result.anchors.push_back(anchor);
        }
    std::vector<Anchor> corners = {{{0}, {1, 0, 0}}, {{0}, {0, 1, 0}}, {{0}, {0, 0, 1}}};
    result.anchors.insert(result.anchors.begin(), corners.begin(), corners.end());
    const glm::vec3 corner[3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
    for (const Anchor& anchor : result.anchors) {
        glm::vec3 position(0);
        for (int k = 0; k < 3; ++k) position += anchor.weight[k] * corner[k];
        result.vertices.positions.push_back(position);
        result.vertices.normals.push_back(up);
        result.vertices.colors.emplace_back(0, 0, 0, 1);
    }
    return result;
}

// Fits a level that consists of the triangles in `indices`.
defocus::engine::LevelFit fitOf(const OneTriangle& t, const std::vector<std::uint32_t>& indices = {0, 1, 2}) {
    const WeldedPositions positions = weldPositions(t.vertices.positions);
    const VertexGroups smoothing = smoothingGroups(t.vertices.normals, positions);
    FitSource source = prepareFit(t.vertices, positions, smoothing, numberedTriangles<MeshVertexNumber>({indices}));
    // all vertices get the same area, since level 0 has no triangles here
    source.areas.assign(t.anchors.size(), 1);
    source.bounds.extend({0, 0, 1});
    LevelMesh level;
    level.triangles = numberedTriangles<LevelVertexNumber>({indices});
    for (std::uint32_t v = 0; v < indices.size(); ++v) level.sources.push_back({v});
    level.apart.assign(indices.size(), 0);
    return fitLevel(source, level, t.anchors);
}

TEST(LevelFit, flatTriangleStaysWhereItIs) {
    const OneTriangle t = oneTriangle();
    const defocus::engine::LevelFit fitted = fitOf(t);
    for (std::uint32_t v = 0; v < 3; ++v)
        EXPECT_NEAR(glm::distance(fitted.positions[{v}], t.vertices.positions[v]), 0, 1e-6);
}

// A fitted triangle rises to the bulge that it replaces. Before the fit, all vertices except the triangle's corners lie
// 0.3 above it. Least squares raise it by almost 0.3.
TEST(LevelFit, triangleRisesToTheBulgeItStandsFor) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 3; v < t.vertices.positions.size(); ++v) t.vertices.positions[v].z = 0.3f;
    const defocus::engine::LevelFit fitted = fitOf(t);
    const float mean = (fitted.positions[{0}].z + fitted.positions[{1}].z + fitted.positions[{2}].z) / 3;
    EXPECT_GT(mean, 0.25f);
    EXPECT_LT(mean, 0.3f);
}

TEST(LevelFit, farFromTheOriginNothingIsLost) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.positions.size(); ++v) {
        t.vertices.positions[v] += glm::vec3(4096, -4096, 0);  // floats are 0.0005 apart at this magnitude
        if (v >= 3) t.vertices.positions[v].z = 0.3f;
    }
    const defocus::engine::LevelFit fitted = fitOf(t);
    EXPECT_GT((fitted.positions[{0}].z + fitted.positions[{1}].z + fitted.positions[{2}].z) / 3, 0.25f);
    for (std::uint32_t v = 0; v < 3; ++v)
        EXPECT_NEAR(glm::distance(glm::vec2(fitted.positions[{v}]), glm::vec2(t.vertices.positions[v])), 0, 0.01);
}

TEST(LevelFit, colourThatIsLinearOverTheTriangleIsKept) {
    OneTriangle t = oneTriangle();
    const float corner[3] = {0.16f, 0.47f, 0.86f};
    for (std::uint32_t v = 0; v < t.anchors.size(); ++v) {
        float value = 0;
        for (int k = 0; k < 3; ++k) value += t.anchors[{v}].weight[k] * corner[k];
        t.vertices.colors[v].r = value;
    }
    const defocus::engine::LevelFit fitted = fitOf(t);
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_NEAR(fitted.colors[{v}].r, corner[v], 0.016f);
    EXPECT_NEAR(fitted.colors[{0}].a, 1, 1e-5f);
}

// Fitted colours may be negative, so that a triangle keeps its mean colour. The surface is dark except at one corner.
// The best linear fit is below 0 on the opposite side, and clamping the fit would brighten the triangle.
TEST(LevelFit, coloursOvershootRatherThanBrighten) {
    OneTriangle t = oneTriangle();
    double mean = 0;
    for (std::uint32_t v = 0; v < t.anchors.size(); ++v) {
        t.vertices.colors[v].r = t.anchors[{v}].weight[0] > 0.6f ? 1.0f : 0.0f;
        mean += double{t.vertices.colors[v].r} / static_cast<double>(t.anchors.size());
    }
    const defocus::engine::LevelFit fitted = fitOf(t);
    EXPECT_LT(std::min(fitted.colors[{1}].r, fitted.colors[{2}].r), -0.02f);
    double shown = 0;
    for (const Anchor& anchor : t.anchors)
        for (std::uint32_t k = 0; k < 3; ++k)
            shown += double{anchor.weight[k]} * double{fitted.colors[{k}].r} / static_cast<double>(t.anchors.size());
    EXPECT_NEAR(shown, mean, 0.004);
}

// Vertices with the same anchor (point of the level that represents a vertex) count as one vertex at that anchor.
TEST(LevelFit, whatSharesAnAnchorCountsThere) {
    OneTriangle t = oneTriangle();
    for (std::uint32_t v = 3; v + 1 < t.anchors.size(); v += 2) {
        t.vertices.colors[v].r = 0.2f;
        t.vertices.colors[v + 1].r = 0.8f;
        t.anchors[{v + 1}] = Anchor::sharedWith({v});
    }
    for (std::uint32_t v = 0; v < 3; ++v) t.vertices.colors[v].r = 0.5f;
    t.vertices.colors.back().r = 0.5f;
    const defocus::engine::LevelFit fitted = fitOf(t);
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_NEAR(fitted.colors[{v}].r, 0.5f, 1e-4f);
}

TEST(LevelFit, meanColourBecomesLevel0s) {
    const OneTriangle t = oneTriangle();
    const WeldedPositions positions = weldPositions(t.vertices.positions);
    const VertexGroups smoothing = smoothingGroups(t.vertices.normals, positions);
    FitSource source = prepareFit(t.vertices, positions, smoothing, numberedTriangles<MeshVertexNumber>({{0, 1, 2}}));
    source.meanColor = {0.3, 0.4, 0.5, 1};
    LevelMesh level;
    level.triangles = numberedTriangles<LevelVertexNumber>({{0, 1, 2}});
    level.sources = numbered<Numbered<LevelVertexNumber, MeshVertexNumber>>({0, 1, 2});
    level.apart.assign(3, 0);
    defocus::engine::LevelFit fit;
    fit.positions = {t.vertices.positions[0], t.vertices.positions[1], t.vertices.positions[2]};
    fit.normals = {up, up, up};
    fit.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 2, 1}};
    conserve(source, level, fit);
    const glm::vec4 mean = (fit.colors[{0}] + fit.colors[{1}] + fit.colors[{2}]) / 3.0f;
    EXPECT_LT(glm::distance(mean, glm::vec4(source.meanColor)), 1e-6f);
    EXPECT_NEAR(fit.colors[{0}].r - fit.colors[{1}].r, 1, 1e-6) << "all are shifted alike";
}

// A linear fit of the texture coordinates u = x², v = y over a triangle leaves the mean texture position unchanged.
TEST(LevelFit, textureLiesWhereItDid) {
    OneTriangle t = oneTriangle();
    for (const glm::vec3& p : t.vertices.positions) t.vertices.uv0.emplace_back(0.01f * p.x * p.x, 0.1f * p.y);
    const defocus::engine::LevelFit fitted = fitOf(t);
    ASSERT_EQ(fitted.uv0.size(), 3u);
    EXPECT_TRUE(fitted.uv1.empty());
    const auto shift = [&](const auto& cornerOf) {
        glm::dvec2 sum(0);
        for (std::uint32_t v = 0; v < t.anchors.size(); ++v) {
            glm::vec2 here(0);
            for (std::uint32_t k = 0; k < 3; ++k) here += t.anchors[{v}].weight[k] * cornerOf(k);
            sum += glm::dvec2(here - t.vertices.uv0[v]) / static_cast<double>(t.anchors.size());
        }
        return glm::length(sum);
    };
    ASSERT_GT(shift([&](std::uint32_t k) { return t.vertices.uv0[k]; }), 0.1);
    EXPECT_LT(shift([&](std::uint32_t k) { return fitted.uv0[{k}]; }), 0.005);
}

// Texture coordinates at a seam are not fitted. Here, a corner lies on a seam because a second vertex at its position
// has other texture coordinates.
TEST(LevelFit, textureCoordinatesAtSeamsStay) {
    OneTriangle t = oneTriangle();
    for (const glm::vec3& p : t.vertices.positions) t.vertices.uv0.emplace_back(0.01f * p.x * p.x, 0.1f * p.y);
    t.vertices.positions.push_back(t.vertices.positions[0]);
    t.vertices.normals.push_back(up);
    t.vertices.colors.emplace_back(0, 0, 0, 1);
    t.vertices.uv0.emplace_back(0.5f, 0.5f);
    t.anchors.push_back({});
    const defocus::engine::LevelFit fitted = fitOf(t);
    EXPECT_EQ(fitted.uv0[{0}], t.vertices.uv0[0]);
    EXPECT_NE(fitted.uv0[{1}], t.vertices.uv0[1]);
}

// The texture coordinates of one UV chart are fitted without regard to vertices of other charts.
TEST(LevelFit, otherChartsDoNotPullAtATexture) {
    OneTriangle t = oneTriangle();
    for (const glm::vec3& p : t.vertices.positions) t.vertices.uv0.emplace_back(0.1f * p.x, 0.1f * p.y);
    for (std::size_t v = 3; v < t.anchors.size(); v += 3) t.vertices.uv0[v] += glm::vec2(3, 0);
    const defocus::engine::LevelFit fitted = fitOf(t);
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_LT(glm::distance(fitted.uv0[{v}], t.vertices.uv0[v]), 1e-5f);
}

// A surviving vertex at a small dark spot does not darken the entire triangle.
TEST(LevelFit, colourOfOneSpotIsOutvoted) {
    OneTriangle t = oneTriangle();
    for (auto& color : t.vertices.colors) color.r = 0.8f;
    t.vertices.colors[0].r = 0;
    EXPECT_GT(fitOf(t).colors[{0}].r, 0.47f);
}

TEST(LevelFit, normalsOfAReliefAveragedGetShorter) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.normals.size(); ++v)
        t.vertices.normals[v] = glm::normalize(glm::vec3(v % 2 == 0 ? 0.5f : -0.5f, 0, 1));
    const defocus::engine::LevelFit fitted = fitOf(t);
    glm::vec3 mean(0);
    for (std::uint32_t v = 0; v < 3; ++v) mean += fitted.normals[{v}] / 3.0f;
    EXPECT_NEAR(mean.z, 1 / std::sqrt(1.25), 0.01);  // the mean normal of both slopes points up and has this length
    EXPECT_NEAR(mean.x, 0, 0.1);
}

TEST(LevelFit, equalNormalsStayUnitLength) {
    const OneTriangle t = oneTriangle();
    for (const glm::vec3& normal : fitOf(t).normals) EXPECT_NEAR(glm::distance(normal, up), 0, 1e-5);
}

TEST(LevelFit, verticesThatNobodyNamesKeepTheirOwn) {
    OneTriangle t = oneTriangle();
    t.vertices.colors[4] = {0.9f, 0.8f, 0.7f, 0.6f};
    t.vertices.normals[4] = right;
    t.vertices.positions[4] = {2, 3, 0};
    const defocus::engine::LevelFit fitted = fitOf(t, {0, 1, 2, 3, 4, 5});
    EXPECT_EQ(fitted.positions[{4}], t.vertices.positions[4]);
    EXPECT_EQ(fitted.colors[{4}], t.vertices.colors[4]);
    EXPECT_EQ(fitted.normals[{4}], right);
}

// A twin is a vertex of a level with the same position and normal as another vertex of the level. The fitted normal of
// the twin depends only on the vertices of level 0 that the twin itself represents.
TEST(LevelFit, aTwinHasANormalOfItsOwn) {
    OneTriangle t = oneTriangle();
    for (std::size_t v = 0; v < t.vertices.normals.size(); ++v)
        t.vertices.normals[v] = glm::normalize(glm::vec3(0.2f, 0, 1));
    for (std::uint32_t v = 0; v < 3; ++v) t.vertices.normals[v] = up;
    const WeldedPositions positions = weldPositions(t.vertices.positions);
    const VertexGroups smoothing = smoothingGroups(t.vertices.normals, positions);
    FitSource source = prepareFit(t.vertices, positions, smoothing, numberedTriangles<MeshVertexNumber>({{0, 1, 2}}));
    source.areas.assign(t.anchors.size(), 1);
    const LevelMesh level{numberedTriangles<LevelVertexNumber>({{0, 1, 2, 3, 1, 2}}),
                          numbered<Numbered<LevelVertexNumber, MeshVertexNumber>>({0, 1, 2, 0}),
                          {0, 0, 0, 1},
                          {},
                          {}};
    const defocus::engine::LevelFit fitted = fitLevel(source, level, t.anchors);
    EXPECT_EQ(fitted.positions[{3}], fitted.positions[{0}]);
    EXPECT_GT(fitted.normals[{0}].x, 0.05f);
    EXPECT_EQ(fitted.normals[{3}], up);
}

}  // namespace
}  // namespace defocus::engine
