// Fits the texture coordinates of a level so that the texture appears at the same position as on level 0. Coordinates
// at seams are kept, so that the boundary of each chart is preserved. No triangle flips in texture space or changes its
// area there by more than a factor of two.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "lod/simplify/fit_data.h"

namespace defocus::engine {

namespace {

// Max distance in texture space between a mesh vertex and its closest point on the level, relative to the longest side
// of the level's triangle in texture space. A vertex at a greater distance belongs to another chart.
constexpr float maxTextureGap = 0.5f;

// Returns whether the displacement `gap` in texture space leads from a triangle with these corners to another chart.
bool leavesChart(const glm::vec2& gap, const std::array<glm::vec2, 3>& corners) {
    float longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 side = corners[(k + 1) % 3] - corners[k];
        longest = std::max(longest, glm::dot(side, side));
    }
    return !(glm::dot(gap, gap) <= maxTextureGap * maxTextureGap * longest);
}

// Sums of displacements in texture space from the anchors (points on the level) to the mesh vertices, for the
// least-squares fit of texture coordinates.
struct TextureSums {
    struct Vertex {
        double weight = 0;
        std::array<double, 4> gap{};  // weighted sums of displacements: uv0, then uv1
    };
    Numbered<LevelVertexNumber, Vertex> vertices;
    Numbered<TriangleNumber, TriangleSums> triangles;
};

TextureSums sumTextureGaps(const FitSource& source, const LevelMesh& level,
                           const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Numbered<TriangleNumber, glm::vec3> normals = unitNormals(source.vertices.positions, level);
    TextureSums sums;
    sums.vertices.resize(level.sources.size());
    sums.triangles.resize(level.triangles.count());
    for (const MeshVertexNumber v : anchors.numbers()) {
        const Anchor& anchor = anchors[v];
        if (anchor.isUnused()) continue;
        const float* w = anchor.weight;
        const auto corner = level.triangles.corners(anchor.triangle);
        Coordinates gap = coordinatesOf(source.vertices, v);
        std::array<glm::vec2, 3> corners0, corners1;
        for (std::size_t k = 0; k < 3; ++k) {
            const Coordinates own = coordinatesOf(source.vertices, level.sources[corner[k]]);
            corners0[k] = own.uv0;
            corners1[k] = own.uv1;
            gap.uv0 -= w[k] * own.uv0;
            gap.uv1 -= w[k] * own.uv1;
        }
        if (leavesChart(gap.uv0, corners0) || leavesChart(gap.uv1, corners1)) continue;
        const float share =
            foreshortened(source.areas[v], anchor, normals[anchor.triangle], source.vertices.normals[v.value]);
        TriangleSums& triangle = sums.triangles[anchor.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = double{share} * double{w[k]};
            triangle[k] += share * w[k] * w[k];
            triangle[3 + k] += share * w[k] * w[(k + 1) % 3];
            TextureSums::Vertex& own = sums.vertices[corner[k]];
            own.weight += weight;
            for (std::size_t c = 0; c < 2; ++c) {
                own.gap[c] += weight * double{gap.uv0[static_cast<glm::length_t>(c)]};
                own.gap[2 + c] += weight * double{gap.uv1[static_cast<glm::length_t>(c)]};
            }
        }
    }
    return sums;
}

// Undoes changes of texture coordinates that flip a triangle in texture space or change its area there by more than a
// factor of two.
void keepTextureUpright(Numbered<UnknownNumber, glm::vec2>& fitted, const Numbered<UnknownNumber, glm::vec2>& original,
                        const LeastSquares& fit) {
    const auto areaOf = [&](const Numbered<UnknownNumber, glm::vec2>& uv, TriangleCorner first) {
        const glm::dvec2 a = uv[fit.corners[first]];
        const glm::dvec2 b = glm::dvec2(uv[fit.corners[nextCorner(first)]]) - a;
        const glm::dvec2 c = glm::dvec2(uv[fit.corners[previousCorner(first)]]) - a;
        return b.x * c.y - b.y * c.x;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const TriangleNumber t : numbersBelow<TriangleNumber>(fit.corners.size() / 3)) {
            const double before = areaOf(original, cornerAt(t, 0));
            const double after = areaOf(fitted, cornerAt(t, 0));
            if (after == before || (after / before > 0.5 && after / before < 2)) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const UnknownNumber g = fit.corners[cornerAt(t, k)];
                changed |= fitted[g] != original[g];
                fitted[g] = original[g];
            }
        }
    }
}

// Returns the texture coordinates `own`, displaced by the channels `channel` and `channel` + 1 of the solution.
Numbered<LevelVertexNumber, glm::vec2> movedCoordinates(const std::vector<glm::vec2>& own, const Grouping& groups,
                                                        const LeastSquares& fit, std::size_t channel) {
    if (own.empty()) return {};
    Numbered<UnknownNumber, glm::vec2> original;
    original.reserve(groups.count());
    for (const MeshVertexNumber v : groups.sources) original.push_back(own[v.value]);
    Numbered<UnknownNumber, glm::vec2> moved = original;
    for (const UnknownNumber g : moved.numbers()) {
        const glm::vec2 place = original[g] + glm::vec2(fit.solution[g][channel], fit.solution[g][channel + 1]);
        if (std::isfinite(place.x) && std::isfinite(place.y)) moved[g] = place;
    }
    keepTextureUpright(moved, original, fit);
    Numbered<LevelVertexNumber, glm::vec2> result;
    result.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) result.push_back(moved[g]);
    return result;
}

}  // namespace

void fitCoordinates(const FitSource& source, const LevelMesh& level, const Numbered<MeshVertexNumber, Anchor>& anchors,
                    LevelFit& fit) {
    if (source.charts.empty()) return;
    const TextureSums sums = sumTextureGaps(source, level, anchors);
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](MeshVertexNumber v) { return source.charts[v]; }, false);
    auto solution = equations<4>(
        level, sums.triangles, groups, [&](LevelVertexNumber v) { return sums.vertices[v].weight; },
        [&](LevelVertexNumber v) { return sums.vertices[v].gap; });
    solution.held.reserve(groups.count());
    for (const MeshVertexNumber v : groups.sources) solution.held.push_back(source.seams[v]);
    solution.solve();
    fit.uv0 = movedCoordinates(source.vertices.uv0, groups, solution, 0);
    fit.uv1 = movedCoordinates(source.vertices.uv1, groups, solution, 2);
}

}  // namespace defocus::engine
