#include "lod/simplify/level_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "lod/simplify/least_squares.h"
#include "lod/simplify/upright.h"

namespace defocus {

namespace {

// Bounds of a vertex's area, in means of all: they keep the equations well conditioned.
constexpr double leastArea = 1e-3;
constexpr double largestArea = 1e3;
// A vertex whose normal stands square to its triangle's counts this much of its area.
constexpr float leastForeshortening = 0.02f;
// Normals that agree less have none that could stand for them.
constexpr float leastAgreement = 0.125f;
// Normals of vertices that share an anchor and differ by more than 60° stand on two sides of an edge.
constexpr float leastSharedCosine = 0.5f;
// An anchor further from its triangle in texture space than this, in the triangle's longest sides there, lies on
// another chart.
constexpr float mostTextureGap = 0.5f;
// Levels of more triangles cover what level 0 does without help.
constexpr std::size_t mostOutlineTriangles = 16'384;

// Twice the area of a triangle, along its normal; at(corner) is its place.
template <typename Corner, typename At>
glm::dvec3 triangleCross(std::span<const Corner, 3> corners, const At& at) {
    const glm::dvec3 a = at(corners[0]);
    return glm::cross(glm::dvec3(at(corners[1])) - a, glm::dvec3(at(corners[2])) - a);
}

// The mean over a surface of what is linear over each of its triangles, value(v) at their corners; 0 without area.
// at(v) is a corner's place.
template <typename Vertex, typename At, typename Value>
glm::dvec4 areaMean(const TriangleSet<Vertex>& triangles, const At& at, const Value& value) {
    glm::dvec4 sum(0);
    double areas = 0;
    for (const TriangleNumber t : triangles.numbers()) {
        const auto corners = triangles.corners(t);
        const double area = glm::length(triangleCross(corners, at));
        if (!std::isfinite(area)) continue;
        sum +=
            area / 3 * (glm::dvec4(value(corners[0])) + glm::dvec4(value(corners[1])) + glm::dvec4(value(corners[2])));
        areas += area;
    }
    return areas > 0 ? sum / areas : glm::dvec4(0);
}

template <typename Vertex>
std::vector<std::uint32_t> plainCorners(const TriangleSet<Vertex>& triangles) {
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.indices.size());
    for (const Vertex v : triangles.indices) corners.push_back(v.value);
    return corners;
}

// Within the smoothing groups, vertices of one colour.
VertexGroups colorGroups(const VertexGroups& smoothing, const std::vector<glm::vec4>& colors) {
    if (colors.empty()) return {};
    Numbered<MeshVertexNumber, std::uint8_t> shared(colors.size(), 0);  // 1: more than one vertex is of the group
    for (const MeshVertexNumber v : shared.numbers())
        if (smoothing[v] != v) shared[smoothing[v]] = 1;
    std::map<std::pair<MeshVertexNumber, std::array<float, 4>>, MeshVertexNumber> leaders;
    VertexGroups groups(colors.size());
    for (const MeshVertexNumber v : groups.numbers()) {
        groups[v] = v;
        if (shared[smoothing[v]] == 0) continue;
        const glm::vec4& c = colors[v.value];
        groups[v] = leaders.try_emplace({smoothing[v], {c.r, c.g, c.b, c.a}}, v).first->second;
    }
    return groups;
}

// Texture coordinates, both sets; 0 of what the vertices don't have.
struct Coordinates {
    glm::vec2 uv0{0};
    glm::vec2 uv1{0};
};

Coordinates coordinatesOf(const Vertices& vertices, MeshVertexNumber v) {
    Coordinates result;
    if (!vertices.uv0.empty()) result.uv0 = vertices.uv0[v.value];
    if (!vertices.uv1.empty()) result.uv1 = vertices.uv1[v.value];
    return result;
}

// Vertices at one position with the same texture coordinates.
VertexGroups chartGroups(const Vertices& vertices, const WeldedPositions& positions) {
    if (vertices.uv0.empty() && vertices.uv1.empty()) return {};
    VertexGroups groups(vertices.count());
    Numbered<PositionNumber, std::uint8_t> shared(positions.first.size(), 0);
    for (const MeshVertexNumber v : groups.numbers())
        if (positions.first[positions.id[v]] != v) shared[positions.id[v]] = 1;
    std::map<std::pair<PositionNumber, std::array<float, 4>>, MeshVertexNumber> leaders;
    for (const MeshVertexNumber v : groups.numbers()) {
        groups[v] = v;
        if (shared[positions.id[v]] == 0) continue;
        const auto [uv0, uv1] = coordinatesOf(vertices, v);
        groups[v] = leaders.try_emplace({positions.id[v], {uv0.x, uv0.y, uv1.x, uv1.y}}, v).first->second;
    }
    return groups;
}

Numbered<MeshVertexNumber, std::uint8_t> seamVertices(const VertexGroups& charts, const WeldedPositions& positions) {
    Numbered<PositionNumber, std::uint8_t> atSeam(positions.first.size(), 0);
    for (const MeshVertexNumber v : charts.numbers())
        if (charts[v] != charts[positions.first[positions.id[v]]]) atSeam[positions.id[v]] = 1;
    Numbered<MeshVertexNumber, std::uint8_t> seams;
    seams.reserve(charts.size());
    for (const MeshVertexNumber v : charts.numbers()) seams.push_back(atSeam[positions.id[v]]);
    return seams;
}

Numbered<MeshVertexNumber, float> vertexAreas(const std::vector<glm::vec3>& positions,
                                              const TriangleSet<MeshVertexNumber>& triangles) {
    Numbered<MeshVertexNumber, double> areas(positions.size(), 0);
    double sum = 0;
    for (const TriangleNumber t : triangles.numbers()) {
        const auto corners = triangles.corners(t);
        const double area = glm::length(triangleCross(corners, [&](MeshVertexNumber v) { return positions[v.value]; }));
        if (!std::isfinite(area)) continue;
        for (const MeshVertexNumber v : corners) areas[v] += area;
        sum += 3 * area;
    }
    const double mean = sum / static_cast<double>(positions.size());
    Numbered<MeshVertexNumber, float> relative(positions.size(), 1);
    if (!(mean > 0)) return relative;
    for (const MeshVertexNumber v : areas.numbers())
        relative[v] = static_cast<float>(std::clamp(areas[v] / mean, leastArea, largestArea));
    return relative;
}

// What the anchors give a vertex of the level: sums of share · weight, and of that times their own values.
struct VertexSums {
    double weight = 0;
    std::array<double, 3> gap{};  // from the point of the level to the vertex that lies there
    std::array<double, 3> normal{};
    std::array<double, 4> color{};
};

struct AnchorSums {
    Numbered<LevelVertexNumber, VertexSums> vertices;
    Numbered<TriangleNumber, TriangleSums> triangles;
};

// Unit length; zero of a triangle without area.
Numbered<TriangleNumber, glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level) {
    Numbered<TriangleNumber, glm::vec3> normals;
    normals.reserve(level.triangles.count());
    for (const TriangleNumber t : level.triangles.numbers()) {
        const glm::dvec3 normal = triangleCross(level.triangles.corners(t),
                                                [&](LevelVertexNumber v) { return positions[level.sources[v].value]; });
        const double length = glm::length(normal);
        normals.push_back(length > 0 ? glm::vec3(normal / length) : glm::vec3(0));
    }
    return normals;
}

bool isUnused(const Anchor& anchor) {
    return anchor.weight[0] == 0 && anchor.weight[1] == 0 && anchor.weight[2] == 0;
}

// What an anchor stands for: its own vertex, and those that share it.
struct Anchored {
    float area = 0;
    glm::vec3 normal{0};  // the mean over the area
    glm::vec4 color{0};   // the same; 0 without colours
};

// Of each vertex; of those without an anchor of their own they mean nothing.
Numbered<MeshVertexNumber, Anchored> anchoredValues(const FitSource& source,
                                                    const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Vertices& vertices = source.vertices;
    Numbered<MeshVertexNumber, Anchored> sums(anchors.size());
    for (const MeshVertexNumber v : anchors.numbers()) {
        const MeshVertexNumber other = anchors[v].sharedWith;
        Anchored& sum = sums[other.isValid() ? other : v];
        sum.area += source.areas[v];
        const glm::vec3& normal = vertices.normals[v.value];
        const glm::vec3& shared = vertices.normals[(other.isValid() ? other : v).value];
        const bool acrossEdge = glm::dot(normal, shared) < leastSharedCosine;
        sum.normal += source.areas[v] * (acrossEdge ? shared : normal);
        if (!vertices.colors.empty()) sum.color += source.areas[v] * vertices.colors[v.value];
    }
    for (Anchored& sum : sums) {
        if (!(sum.area > 0)) continue;
        sum.normal /= sum.area;
        sum.color /= sum.area;
    }
    return sums;
}

// How much of its triangle, whose unit normal is `face`, an area with this normal stands for, seen straight on.
float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal) {
    const float* w = anchor.weight;
    const bool atCorner = w[0] == 1 || w[1] == 1 || w[2] == 1;
    if (atCorner || face == glm::vec3(0)) return area;
    return area * std::clamp(glm::dot(face, normal), leastForeshortening, 1.0f);
}

AnchorSums sumAnchors(const FitSource& source, const LevelMesh& level,
                      const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Vertices& vertices = source.vertices;
    const Numbered<TriangleNumber, glm::vec3> normals = unitNormals(vertices.positions, level);
    const Numbered<MeshVertexNumber, Anchored> values = anchoredValues(source, anchors);
    AnchorSums sums;
    sums.vertices.resize(level.sources.size());
    sums.triangles.resize(level.triangles.count());
    for (const MeshVertexNumber v : anchors.numbers()) {
        const Anchor& anchor = anchors[v];
        const float* w = anchor.weight;
        if (isUnused(anchor)) continue;
        const auto corner = level.triangles.corners(anchor.triangle);
        const Anchored& value = values[v];
        const float share = foreshortened(value.area, anchor, normals[anchor.triangle], value.normal);

        // Displacements are fitted rather than positions: they are small, so that single precision does far from the
        // origin too.
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
            VertexSums& own = sums.vertices[corner[k]];
            own.weight += weight;
            for (std::size_t c = 0; c < 3; ++c) {
                own.gap[c] += weight * double{gap[static_cast<glm::length_t>(c)]};
                own.normal[c] += weight * double{value.normal[static_cast<glm::length_t>(c)]};
            }
            for (std::size_t c = 0; c < 4; ++c)
                own.color[c] += weight * double{value.color[static_cast<glm::length_t>(c)]};
        }
    }
    return sums;
}

// The level's vertices in groups that share a value.
struct Grouping {
    Numbered<LevelVertexNumber, UnknownNumber> of;
    Numbered<UnknownNumber, MeshVertexNumber> sources;  // whose value each group starts from
    [[nodiscard]] std::size_t count() const { return sources.size(); }
};

// `leaderOf` says which of the `count` mesh vertices leads another's group. With `sidesApart`, vertices that stand
// apart have groups of their own.
template <typename LeaderOf>
Grouping grouped(const LevelMesh& level, std::size_t count, const LeaderOf& leaderOf, bool sidesApart) {
    Numbered<MeshVertexNumber, UnknownNumber> numbers(count);
    std::unordered_map<MeshVertexNumber, UnknownNumber> numbersApart;
    Grouping groups;
    for (const LevelVertexNumber v : level.sources.numbers()) {
        const MeshVertexNumber leader = leaderOf(level.sources[v]);
        UnknownNumber& number = sidesApart && level.apart[v] != 0 ? numbersApart[leader] : numbers[leader];
        if (!number.isValid()) {
            number = groups.sources.next();
            groups.sources.push_back(leader);
        }
        groups.of.push_back(number);
    }
    return groups;
}

// The equations with every unknown's sums; solutions start at zero. `value` picks the values of what `sums` holds for
// each of the level's vertices.
template <std::size_t channels, typename Sums, typename Value>
LeastSquares equations(const LevelMesh& level, const Sums& sums, const Grouping& groups, const Value& value) {
    LeastSquares result;
    result.triangles = sums.triangles;
    result.corners.reserve(level.triangles.indices.size());
    for (const LevelVertexNumber v : level.triangles.indices) result.corners.push_back(groups.of[v]);
    Numbered<UnknownNumber, double> weights(groups.count(), 0);
    Numbered<UnknownNumber, std::array<double, channels>> targets(groups.count());
    for (const LevelVertexNumber v : groups.of.numbers()) {
        const UnknownNumber g = groups.of[v];
        weights[g] += sums.vertices[v].weight;
        for (std::size_t c = 0; c < channels; ++c) targets[g][c] += value(sums.vertices[v])[c];
    }
    result.weights.assign(weights.begin(), weights.end());
    result.sums.resize(groups.count());
    for (const UnknownNumber g : targets.numbers())
        for (std::size_t c = 0; c < channels; ++c) result.sums[g][c] = static_cast<float>(targets[g][c]);
    result.solution.assign(groups.count(), LeastSquares::Row{});
    return result;
}

// Starts from the mean of what each unknown stands for; from `own(group)` where it stands for nothing.
template <std::size_t channels, typename Own>
void startFromMeans(LeastSquares& fit, const Own& own) {
    for (const UnknownNumber g : fit.weights.numbers())
        for (std::size_t c = 0; c < channels; ++c)
            fit.solution[g][c] = fit.weights[g] > 0 ? fit.sums[g][c] / fit.weights[g] : own(g, c);
}

Numbered<LevelVertexNumber, glm::vec3> fitPositions(const FitSource& source, const LevelMesh& level,
                                                    const AnchorSums& sums) {
    const auto leaderOf = [&](MeshVertexNumber v) { return source.positions.first[source.positions.id[v]]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, false);
    auto fit = equations<3>(level, sums, groups, [](const VertexSums& v) { return v.gap; });
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

// Of the triangles around each group, weighed by their areas; zero where there are none.
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

// For each group, the mean cosine between the mesh's normals and what the level interpolates from `normals`. Curvature
// that the level still has costs nothing, only what it has lost does.
Numbered<UnknownNumber, float> agreements(const FitSource& source, const LevelMesh& level,
                                          const Numbered<MeshVertexNumber, Anchor>& anchors, const Grouping& groups,
                                          const Numbered<UnknownNumber, glm::vec3>& normals) {
    const Numbered<TriangleNumber, glm::vec3> faces = unitNormals(source.vertices.positions, level);
    Numbered<UnknownNumber, double> cosines(groups.count(), 0);
    Numbered<UnknownNumber, double> weights(groups.count(), 0);
    for (const MeshVertexNumber v : anchors.numbers()) {
        const Anchor& anchor = anchors[v];
        if (isUnused(anchor)) continue;
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
        const double mean = cosines[g] / weights[g];  // no number where nothing counts
        if (std::isfinite(mean)) result[g] = std::clamp(static_cast<float>(mean), leastAgreement, 1.0f);
    }
    return result;
}

// A fit that is no normal of the triangles around it, with their corners at `positions`, is replaced by theirs, of
// length 1.
Numbered<LevelVertexNumber, glm::vec3> fitNormals(const FitSource& source, const LevelMesh& level,
                                                  const Numbered<MeshVertexNumber, Anchor>& anchors,
                                                  const AnchorSums& sums,
                                                  const Numbered<LevelVertexNumber, glm::vec3>& positions) {
    // Fitted as vectors: their means are shorter than 1 where they differ.
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](MeshVertexNumber v) { return source.smoothing[v]; }, true);
    const std::vector<glm::vec3>& own = source.vertices.normals;
    auto fit = equations<3>(level, sums, groups, [](const VertexSums& v) { return v.normal; });
    startFromMeans<3>(
        fit, [&](UnknownNumber g, std::size_t c) { return own[groups.sources[g].value][static_cast<int>(c)]; });
    fit.solve();

    const Numbered<UnknownNumber, glm::dvec3> faces = faceNormals(positions, level, groups);
    Numbered<UnknownNumber, glm::vec3> directions(groups.count());
    Numbered<UnknownNumber, std::uint8_t> replaced(groups.count(), 0);
    for (const UnknownNumber g : directions.numbers()) {
        const auto& row = fit.solution[g];
        const glm::vec3 normal(row[0], row[1], row[2]);
        const float length = glm::length(normal);
        const double faceLength = glm::length(faces[g]);
        if (length > leastAgreement && glm::dot(glm::dvec3(normal), faces[g]) >= 0) {
            directions[g] = normal / length;
        } else {
            directions[g] = faceLength > 0 ? glm::vec3(faces[g] / faceLength) : own[groups.sources[g].value];
            replaced[g] = 1;
        }
    }
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
    auto fit = equations<4>(level, sums, groups, [](const VertexSums& v) { return v.color; });
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

// Whether a gap in a triangle with these corners is one to another chart.
bool leavesChart(const glm::vec2& gap, const std::array<glm::vec2, 3>& corners) {
    float longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 side = corners[(k + 1) % 3] - corners[k];
        longest = std::max(longest, glm::dot(side, side));
    }
    return !(glm::dot(gap, gap) <= mostTextureGap * mostTextureGap * longest);
}

// The same as AnchorSums, of the way in texture space from the point of the level to the vertex that lies there.
struct TextureSums {
    struct Vertex {
        double weight = 0;
        std::array<double, 4> gap{};  // uv0, then uv1
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
        if (isUnused(anchor)) continue;
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

// Takes back what turned a triangle over in texture space, or made it less than half or more than twice as large.
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

// One set of the coordinates, moved by what two of the fit's channels say, from `channel` on.
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

// Fits texture coordinates so that the level shows the texture where level 0 does. Those at seams stay as they are.
void fitCoordinates(const FitSource& source, const LevelMesh& level, const Numbered<MeshVertexNumber, Anchor>& anchors,
                    LevelFit& result) {
    if (source.charts.empty()) return;
    const TextureSums sums = sumTextureGaps(source, level, anchors);
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](MeshVertexNumber v) { return source.charts[v]; }, false);
    auto fit = equations<4>(level, sums, groups, [](const TextureSums::Vertex& v) { return v.gap; });
    fit.held.reserve(groups.count());
    for (const MeshVertexNumber v : groups.sources) fit.held.push_back(source.seams[v]);
    fit.solve();
    result.uv0 = movedCoordinates(source.vertices.uv0, groups, fit, 0);
    result.uv1 = movedCoordinates(source.vertices.uv1, groups, fit, 2);
}

void conserveOutline(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (level.triangles.count() > mostOutlineTriangles) return;
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

// A component of a level and how it is scaled.
struct Grown {
    double area = 0;
    Bounds box;
    double factor = 1;
    glm::dvec3 shift{0};  // back into level 0's box

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p, const glm::dvec3& centre) const {
        return centre + factor * (p - centre) + shift;
    }
};

void chooseGrowth(Grown& grown, const Growth& growth, const Bounds& limits) {
    if (!(growth.area > grown.area) || !(grown.area > 0)) return;
    grown.factor = std::min(std::sqrt(growth.area / grown.area), growth.mostFactor);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (const double size = grown.box.size()[axis]; size > 0)
            grown.factor = std::min(grown.factor, limits.size()[axis] / size);
    grown.factor = std::max(grown.factor, 1.0);
    grown.shift = glm::max(glm::dvec3(0), limits.minimum - grown.place(grown.box.minimum, growth.centre)) +
                  glm::min(glm::dvec3(0), limits.maximum - grown.place(grown.box.maximum, growth.centre));
}

// Scales those of the level's components that have less area than they are to stand for. The result stays within
// `limits`.
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

}  // namespace

FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles) {
    FitSource source{vertices, positions, smoothing, {}, {}, {}, {}, {}, glm::dvec4(0), {}};
    source.shades = colorGroups(source.smoothing, vertices.colors);
    source.charts = chartGroups(vertices, positions);
    source.seams = seamVertices(source.charts, positions);
    source.areas = vertexAreas(vertices.positions, triangles);
    for (const MeshVertexNumber v : triangles.indices)
        if (isFinite(vertices.positions[v.value])) source.bounds.extend(glm::dvec3(vertices.positions[v.value]));
    if (!vertices.colors.empty())
        source.meanColor = areaMean(
            triangles, [&](MeshVertexNumber v) { return vertices.positions[v.value]; },
            [&](MeshVertexNumber v) { return vertices.colors[v.value]; });
    const std::vector<std::uint32_t> corners = plainCorners(triangles);
    source.outlines = outlinesOf(vertices.positions, corners, source.bounds);
    return source;
}

void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    conserveOutline(source, level, fit);
    conserveColor(source, level, fit);
}

PatchMeans patchMeans(const FitSource& source, const LevelMesh& level, const LevelFit& fit,
                      const Numbered<MeshVertexNumber, Anchor>& anchors,
                      const Numbered<TriangleNumber, std::uint32_t>& patchOf) {
    std::size_t count = 0;
    for (const std::uint32_t patch : patchOf) count = std::max<std::size_t>(count, std::size_t{patch} + 1);
    PatchMeans means;
    for (std::vector<double>* areas : {&means.areas, &means.areas0}) areas->assign(count, 0);
    for (std::vector<glm::dvec4>* colors : {&means.colors, &means.colors0}) colors->assign(count, glm::dvec4(0));
    for (const TriangleNumber t : level.triangles.numbers()) {
        const auto corners = level.triangles.corners(t);
        const double area =
            0.5 * glm::length(triangleCross(corners, [&](LevelVertexNumber v) { return fit.positions[v]; }));
        means.areas[patchOf[t]] += area;
        for (const LevelVertexNumber v : corners)
            if (!fit.colors.empty()) means.colors[patchOf[t]] += area / 3 * glm::dvec4(fit.colors[v]);
    }
    const Numbered<MeshVertexNumber, Anchored> values = anchoredValues(source, anchors);
    for (const MeshVertexNumber v : anchors.numbers()) {
        if (isUnused(anchors[v])) continue;
        const std::uint32_t patch = patchOf[anchors[v].triangle];
        means.areas0[patch] += double{values[v].area};
        means.colors0[patch] += double{values[v].area} * glm::dvec4(values[v].color);
    }
    for (std::size_t patch = 0; patch < count; ++patch) {
        if (means.areas[patch] > 0) means.colors[patch] /= means.areas[patch];
        if (means.areas0[patch] > 0) means.colors0[patch] /= means.areas0[patch];
    }
    return means;
}

LevelFit fitLevel(const FitSource& source, const LevelMesh& level, Numbered<MeshVertexNumber, Anchor> anchors) {
    LevelFit fit;
    fitCoordinates(source, level, anchors, fit);
    const AnchorSums sums = sumAnchors(source, level, anchors);
    fit.positions = fitPositions(source, level, sums);
    fit.normals = fitNormals(source, level, anchors, sums, fit.positions);
    anchors = {};
    fit.colors = fitColors(source, level, sums);
    growComponents(fit.positions, level, source.bounds);
    return fit;
}

}  // namespace defocus
