#include "lod/simplify/level_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "lod/simplify/fit_data.h"

namespace defocus::engine {

namespace {

// Min length of a fitted normal, a mean of unit normals; a shorter mean has no meaningful direction. Also the lower
// bound of the mean cosine between fitted normals and level 0's normals (agreements()).
constexpr float minAgreement = 0.125f;

// Weights and right-hand sides of the least-squares fits (least_squares.h). An anchor is the point on the level that
// represents a vertex of level 0. It contributes to each corner of its triangle with the weight s·b, where s is the
// anchor's weight in the fit and b its barycentric coordinate for the corner. For each level vertex, `weights` is the
// sum of s·b. `gaps`, `normals` and `colors` are sums of offsets, normals and colours, weighted by s·b.
struct AnchorSums {
    using Three = std::array<double, 3>;
    Numbered<LevelVertexNumber, double> weights;
    Numbered<LevelVertexNumber, Three> gaps;  // sums of offsets from anchors to their vertices of level 0
    Numbered<LevelVertexNumber, Three> normals;
    Numbered<LevelVertexNumber, std::array<double, 4>> colors;  // weighted RGBA; empty if the mesh has no colours
    Numbered<TriangleNumber, TriangleSums> triangles;

    template <std::size_t channels>
    [[nodiscard]] LeastSquares equationsOf(
        const LevelMesh& level, const Grouping& groups,
        const Numbered<LevelVertexNumber, std::array<double, channels>>& values) const {
        return equations<channels>(
            level, triangles, groups, [&](LevelVertexNumber v) { return weights[v]; },
            [&](LevelVertexNumber v) { return values[v]; });
    }
};

AnchorSums sumAnchors(const FitSource& source, const LevelMesh& level,
                      const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Vertices& vertices = source.vertices;
    const Numbered<TriangleNumber, glm::vec3> normals = unitNormals(vertices.positions, level);
    const AnchoredValues anchored = anchoredValues(source, anchors);
    AnchorSums sums;
    const std::size_t count = level.sources.size();
    sums.weights.resize(count);
    sums.gaps.resize(count);
    sums.normals.resize(count);
    if (!anchored.colors.empty()) sums.colors.resize(count);
    sums.triangles.resize(level.triangles.count());
    for (const MeshVertexNumber v : anchors.numbers()) {
        const Anchor& anchor = anchors[v];
        const float* w = anchor.weight;
        if (anchor.isUnused()) continue;
        const auto corner = level.triangles.corners(anchor.triangle);
        const Anchored& value = anchored.values[v];
        const float share = foreshortened(value.area, anchor, normals[anchor.triangle], value.normal);

        // Fit displacements from points on the level instead of positions. They are small, so that single precision
        // suffices even far from the origin.
        glm::dvec3 onLevel(0);
        for (std::size_t k = 0; k < 3; ++k)
            onLevel += double{w[k]} * glm::dvec3(vertices.positions[level.sources[corner[k]].value]);
        const glm::vec3 gap(glm::dvec3(vertices.positions[v.value]) - onLevel);
        TriangleSums& triangle = sums.triangles[anchor.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = double{share} * double{w[k]};
            if (weight == 0) continue;
            triangle[k] += share * w[k] * w[k];
            triangle[3 + k] += share * w[k] * w[(k + 1) % 3];
            sums.weights[corner[k]] += weight;
            for (std::size_t c = 0; c < 3; ++c) {
                sums.gaps[corner[k]][c] += weight * double{gap[static_cast<glm::length_t>(c)]};
                sums.normals[corner[k]][c] += weight * double{value.normal[static_cast<glm::length_t>(c)]};
            }
            for (std::size_t c = 0; c < 4 && !sums.colors.empty(); ++c)
                sums.colors[corner[k]][c] += weight * double{anchored.colors[v][static_cast<glm::length_t>(c)]};
        }
    }
    return sums;
}

// Returns fitted positions; clears AnchorSums::gaps of `sums` to free memory.
Numbered<LevelVertexNumber, glm::vec3> fitPositions(const FitSource& source, const LevelMesh& level, AnchorSums& sums) {
    const auto leaderOf = [&](MeshVertexNumber v) { return source.positions.first[source.positions.id[v]]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, false);
    auto fit = sums.equationsOf(level, groups, sums.gaps);
    sums.gaps = {};
    fit.solve();
    Numbered<UnknownNumber, glm::vec3> original;
    original.reserve(groups.count());
    for (const MeshVertexNumber v : groups.sources) original.push_back(source.vertices.positions[v.value]);
    Numbered<UnknownNumber, glm::vec3> fitted = original;
    for (const UnknownNumber g : fitted.numbers()) {
        const auto& move = fit.solution[g];
        const glm::vec3 moved = original[g] + glm::vec3(move[0], move[1], move[2]);
        if (isFinite(moved))
            fitted[g] = glm::clamp(moved, glm::vec3(source.bounds.minimum), glm::vec3(source.bounds.maximum));
    }
    keepFacesUpright(fitted, original, level.triangles.count(), [&](std::size_t t) {
        const auto corners = level.triangles.corners(itemAt<TriangleNumber>(t));
        return std::array{groups.of[corners[0]], groups.of[corners[1]], groups.of[corners[2]]};
    });
    Numbered<LevelVertexNumber, glm::vec3> positions;
    positions.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) positions.push_back(fitted[g]);
    return positions;
}

// Returns, for each group of vertices that share a normal, the area-weighted sum of the normals of all triangles at the
// group's vertices. The sum is zero if there are no triangles.
Numbered<UnknownNumber, glm::dvec3> faceNormals(const Numbered<LevelVertexNumber, glm::vec3>& positions,
                                                const LevelMesh& level, const Grouping& groups) {
    Numbered<UnknownNumber, glm::dvec3> sums(groups.count(), glm::dvec3(0));
    for (const TriangleNumber t : level.triangles.numbers()) {
        const auto corners = level.triangles.corners(t);
        const glm::dvec3 normal = triangleCross(corners, [&](LevelVertexNumber v) { return positions[v]; });
        for (const LevelVertexNumber v : corners) sums[groups.of[v]] += normal;
    }
    return sums;
}

// Returns, for each group of vertices that share a normal, the mean cosine between the normals of level 0 and the
// interpolated `normals`. Detail that the level has lost lowers this mean; curvature that the level preserves does not
// lower it.
Numbered<UnknownNumber, float> agreements(const FitSource& source, const LevelMesh& level,
                                          const Numbered<MeshVertexNumber, Anchor>& anchors, const Grouping& groups,
                                          const Numbered<UnknownNumber, glm::vec3>& normals) {
    const Numbered<TriangleNumber, glm::vec3> faces = unitNormals(source.vertices.positions, level);
    Numbered<UnknownNumber, double> cosines(groups.count(), 0);
    Numbered<UnknownNumber, double> weights(groups.count(), 0);
    for (const MeshVertexNumber v : anchors.numbers()) {
        const Anchor& anchor = anchors[v];
        if (anchor.isUnused()) continue;
        const auto corner = level.triangles.corners(anchor.triangle);
        const glm::vec3& own = source.vertices.normals[v.value];
        glm::vec3 interpolated(0);
        for (std::size_t k = 0; k < 3; ++k) interpolated += anchor.weight[k] * normals[groups.of[corner[k]]];
        const float length = glm::length(interpolated);
        if (!(length > 0)) continue;
        const double cosine = glm::dot(interpolated, own) / length;
        const float share = foreshortened(source.areas[v], anchor, faces[anchor.triangle], own);
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = double{share} * double{anchor.weight[k]};
            cosines[groups.of[corner[k]]] += weight * cosine;
            weights[groups.of[corner[k]]] += weight;
        }
    }
    Numbered<UnknownNumber, float> result(groups.count(), 1);
    for (const UnknownNumber g : result.numbers()) {
        const double mean = cosines[g] / weights[g];  // NaN for a group of vertices with weight 0
        if (std::isfinite(mean)) result[g] = std::clamp(static_cast<float>(mean), minAgreement, 1.0f);
    }
    return result;
}

// Fits normals without normalizing them, so that they are shorter than 1 where the normals of level 0 diverge. Clears
// AnchorSums::normals of `sums` to free memory.
LeastSquares::Rows meanNormals(const FitSource& source, const LevelMesh& level, const Grouping& groups,
                               AnchorSums& sums) {
    const std::vector<glm::vec3>& own = source.vertices.normals;
    auto fit = sums.equationsOf(level, groups, sums.normals);
    sums.normals = {};
    startFromMeans<3>(
        fit, [&](UnknownNumber g, std::size_t c) { return own[groups.sources[g].value][static_cast<int>(c)]; });
    fit.solve();
    return std::move(fit.solution);
}

// Returns fitted normals. `positions` are the fitted vertex positions. A fitted normal that is very short or points to
// the back of the surrounding triangles is replaced by the mean normal of these triangles.
Numbered<LevelVertexNumber, glm::vec3> fitNormals(const FitSource& source, const LevelMesh& level,
                                                  const Numbered<MeshVertexNumber, Anchor>& anchors, AnchorSums& sums,
                                                  const Numbered<LevelVertexNumber, glm::vec3>& positions) {
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](MeshVertexNumber v) { return source.smoothing[v]; }, true);
    LeastSquares::Rows means = meanNormals(source, level, groups, sums);

    const Numbered<UnknownNumber, glm::dvec3> faces = faceNormals(positions, level, groups);
    Numbered<UnknownNumber, glm::vec3> directions(groups.count());
    Numbered<UnknownNumber, std::uint8_t> replaced(groups.count(), 0);
    for (const UnknownNumber g : directions.numbers()) {
        const auto& row = means[g];
        const glm::vec3 normal(row[0], row[1], row[2]);
        const float length = glm::length(normal);
        const double faceLength = glm::length(faces[g]);
        if (length > minAgreement && glm::dot(glm::dvec3(normal), faces[g]) >= 0) {
            directions[g] = normal / length;
        } else {
            directions[g] =
                faceLength > 0 ? glm::vec3(faces[g] / faceLength) : source.vertices.normals[groups.sources[g].value];
            replaced[g] = 1;
        }
    }
    means = {};
    const Numbered<UnknownNumber, float> agreement = agreements(source, level, anchors, groups, directions);
    Numbered<LevelVertexNumber, glm::vec3> fitted;
    fitted.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) fitted.push_back(directions[g] * (replaced[g] != 0 ? 1.0f : agreement[g]));
    return fitted;
}

Numbered<LevelVertexNumber, glm::vec4> fitColors(const FitSource& source, const LevelMesh& level,
                                                 const AnchorSums& sums) {
    const std::vector<glm::vec4>& own = source.vertices.colors;
    if (own.empty()) return {};
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](MeshVertexNumber v) { return source.shades[v]; }, true);
    auto fit = sums.equationsOf(level, groups, sums.colors);
    startFromMeans<4>(
        fit, [&](UnknownNumber g, std::size_t c) { return own[groups.sources[g].value][static_cast<int>(c)]; });
    fit.solve();
    Numbered<LevelVertexNumber, glm::vec4> fitted(groups.of.size());
    for (const LevelVertexNumber v : fitted.numbers())
        for (glm::length_t c = 0; c < 4; ++c) {
            const float value = fit.solution[groups.of[v]][static_cast<std::size_t>(c)];
            fitted[v][c] = std::isfinite(value) ? value : 0.0f;
        }
    return fitted;
}

// Area and bounding box of a level's component (connected part), and the scaling that restores lost area.
struct Grown {
    double area = 0;
    Bounds box;
    double factor = 1;
    glm::dvec3 shift{0};  // translation of the component back into level 0's bounding box

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p, const glm::dvec3& centre) const {
        return centre + factor * (p - centre) + shift;
    }
};

void chooseGrowth(Grown& grown, const Growth& growth, const Bounds& limits) {
    if (!(growth.area > grown.area) || !(grown.area > 0)) return;
    grown.factor = std::min(std::sqrt(growth.area / grown.area), growth.maxFactor);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (const double size = grown.box.size()[axis]; size > 0)
            grown.factor = std::min(grown.factor, limits.size()[axis] / size);
    grown.factor = std::max(grown.factor, 1.0);
    grown.shift = glm::max(glm::dvec3(0), limits.minimum - grown.place(grown.box.minimum, growth.centre)) +
                  glm::min(glm::dvec3(0), limits.maximum - grown.place(grown.box.maximum, growth.centre));
}

// Enlarges each component (connected part) that is smaller than its target area, given by LevelMesh::growths. The
// result stays inside `limits`.
void growComponents(Numbered<LevelVertexNumber, glm::vec3>& positions, const LevelMesh& level, const Bounds& limits) {
    if (level.growthsOf.empty()) return;
    Numbered<ComponentNumber, Grown> grown(level.growths.size());
    for (const TriangleNumber t : level.triangles.numbers()) {
        const auto corners = level.triangles.corners(t);
        const glm::dvec3 a = positions[corners[0]];
        grown[level.growthsOf[corners[0]]].area +=
            0.5 * glm::length(glm::cross(glm::dvec3(positions[corners[1]]) - a, glm::dvec3(positions[corners[2]]) - a));
    }
    for (const LevelVertexNumber v : positions.numbers())
        grown[level.growthsOf[v]].box.extend(glm::dvec3(positions[v]));
    for (const ComponentNumber g : grown.numbers()) chooseGrowth(grown[g], level.growths[g], limits);
    for (const LevelVertexNumber v : positions.numbers()) {
        const ComponentNumber g = level.growthsOf[v];
        if (grown[g].factor == 1) continue;
        const glm::vec3 moved(grown[g].place(glm::dvec3(positions[v]), level.growths[g].centre));
        positions[v] = glm::clamp(moved, glm::vec3(limits.minimum), glm::vec3(limits.maximum));
    }
}

// Max triangle count of levels whose reflected radiance is corrected. Finer levels match the reflected radiance of
// level 0 without correction.
constexpr std::size_t maxLitTriangles = 16'384;
// Max triangle count of levels whose outline is corrected. Even level 1 may need the correction, because thin parts
// lose area. For levels with more triangles, the correction would take too long.
constexpr std::size_t maxOutlinedTriangles = 131'072;

void conserveOutline(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (level.triangles.count() > maxOutlinedTriangles) return;
    const auto leaderOf = [&](MeshVertexNumber v) { return source.positions.first[source.positions.id[v]]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, false);
    std::vector<std::uint32_t> places;
    places.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) places.push_back(g.value);
    fitOutlines(fit.positions, plainCorners(level.triangles), places, source.outlines, source.bounds);
}

void conserveColor(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (fit.colors.empty()) return;
    const glm::dvec4 own = areaMean(
        level.triangles, [&](LevelVertexNumber v) { return fit.positions[v]; },
        [&](LevelVertexNumber v) { return fit.colors[v]; });
    for (glm::vec4& color : fit.colors) color += glm::vec4(source.meanColor - own);
}

void conserveLight(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (level.triangles.count() > maxLitTriangles) return;
    const auto leaderOf = [&](MeshVertexNumber v) { return source.smoothing[v]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, true);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) numbers.push_back(g.value);
    fitLight(fit.positions, fit.colors, plainCorners(level.triangles), numbers, source.light, fit.normals);
}

}  // namespace

LevelFit fitLevel(const FitSource& source, const LevelMesh& level, Numbered<MeshVertexNumber, Anchor> anchors) {
    LevelFit fit;
    fitCoordinates(source, level, anchors, fit);
    AnchorSums sums = sumAnchors(source, level, anchors);
    fit.positions = fitPositions(source, level, sums);
    fit.normals = fitNormals(source, level, anchors, sums, fit.positions);
    anchors = {};
    fit.colors = fitColors(source, level, sums);
    growComponents(fit.positions, level, source.bounds);
    return fit;
}

void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    conserveOutline(source, level, fit);
    conserveColor(source, level, fit);
    conserveLight(source, level, fit);
}

}  // namespace defocus::engine
