#include "lod/simplify/level_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_map>

#include "lod/simplify/least_squares.h"

namespace defocus {

namespace {

// Bounds of a vertex's area, in means of all: they keep the equations well conditioned.
constexpr double leastArea = 1e-3;
constexpr double largestArea = 1e3;
// A vertex whose normal stands square to its triangle's counts this much of its area.
constexpr float leastForeshortening = 0.02f;
// A fitted triangle that is turned by more than 60° goes back to where it was.
constexpr double leastFittedTurnCosine = 0.5;
constexpr std::uint32_t ungrouped = 0xffffffffu;

// Within the smoothing groups, vertices of one colour.
std::vector<std::uint32_t> colorGroups(std::span<const std::uint32_t> smoothing,
                                       const std::vector<glm::u8vec4>& colors) {
    if (colors.empty()) return {};
    std::vector<std::uint8_t> shared(colors.size(), 0);  // 1: more than one vertex has it as its smoothing group
    for (std::uint32_t v = 0; v < colors.size(); ++v)
        if (smoothing[v] != v) shared[smoothing[v]] = 1;
    std::map<std::array<std::uint32_t, 5>, std::uint32_t> leaders;
    std::vector<std::uint32_t> groups(colors.size());
    for (std::uint32_t v = 0; v < groups.size(); ++v) {
        groups[v] = v;
        if (shared[smoothing[v]] == 0) continue;
        const glm::u8vec4& c = colors[v];
        groups[v] = leaders.try_emplace({smoothing[v], c.r, c.g, c.b, c.a}, v).first->second;
    }
    return groups;
}

std::vector<float> vertexAreas(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> indices) {
    std::vector<double> areas(positions.size(), 0);
    double sum = 0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        const double area = glm::length(
            glm::cross(glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a));
        if (!std::isfinite(area)) continue;
        for (std::size_t k = 0; k < 3; ++k) areas[indices[i + k]] += area;
        sum += 3 * area;
    }
    const double mean = sum / static_cast<double>(positions.size());
    std::vector<float> relative(positions.size(), 1);
    for (std::size_t v = 0; v < areas.size() && mean > 0; ++v)
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
    std::vector<VertexSums> vertices;     // of the level
    std::vector<TriangleSums> triangles;  // of the level
};

// Unit length; zero of a triangle without area.
std::vector<glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level) {
    std::vector<glm::vec3> normals;
    normals.reserve(level.triangles.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < level.triangles.indices.size(); i += 3) {
        const glm::dvec3 a = positions[level.sources[level.triangles.indices[i]]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(positions[level.sources[level.triangles.indices[i + 1]]]) - a,
                                             glm::dvec3(positions[level.sources[level.triangles.indices[i + 2]]]) - a);
        const double length = glm::length(normal);
        normals.push_back(length > 0 ? glm::vec3(normal / length) : glm::vec3(0));
    }
    return normals;
}

AnchorSums sumAnchors(const FitSource& source, const LevelMesh& level, std::span<const Anchor> anchors) {
    const Vertices& vertices = source.vertices;
    const std::vector<glm::vec3> normals = unitNormals(vertices.positions, level);
    AnchorSums sums;
    sums.vertices.resize(level.sources.size());
    sums.triangles.resize(level.triangles.indices.size() / 3);
    for (std::size_t v = 0; v < anchors.size(); ++v) {
        const Anchor& anchor = anchors[v];
        const float* w = anchor.weight;
        if (w[0] == 0 && w[1] == 0 && w[2] == 0) continue;
        const std::uint32_t* const corner = &level.triangles.indices[3 * std::size_t{anchor.triangle}];
        const bool atCorner = w[0] == 1 || w[1] == 1 || w[2] == 1;
        const glm::vec3& normal = vertices.normals[v];
        const glm::vec3& face = normals[anchor.triangle];
        // How much of its triangle the vertex stands for, seen straight on.
        float share = anchor.count * source.areas[v];
        if (!atCorner && face != glm::vec3(0)) share *= std::clamp(glm::dot(face, normal), leastForeshortening, 1.0f);

        // Displacements are fitted rather than positions: they are small, so that single precision does far from the
        // origin too.
        glm::dvec3 onLevel(0);
        for (int k = 0; k < 3; ++k) onLevel += double{w[k]} * glm::dvec3(vertices.positions[level.sources[corner[k]]]);
        const glm::vec3 gap(glm::dvec3(vertices.positions[v]) - onLevel);
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
                own.normal[c] += weight * double{normal[static_cast<glm::length_t>(c)]};
            }
            if (vertices.colors.empty()) continue;
            for (std::size_t c = 0; c < 4; ++c)
                own.color[c] += weight * static_cast<double>(vertices.colors[v][static_cast<glm::length_t>(c)]);
        }
    }
    return sums;
}

// The level's vertices in groups that share a value.
struct Grouping {
    std::vector<std::uint32_t> of;       // for each vertex of the level
    std::vector<std::uint32_t> sources;  // for each group, the vertex of the mesh whose value it starts from
    [[nodiscard]] std::size_t count() const { return sources.size(); }
};

// `leaderOf` says which of the `count` mesh vertices leads another's group. With `sidesApart`, vertices that stand
// apart have groups of their own.
template <typename LeaderOf>
Grouping grouped(const LevelMesh& level, std::size_t count, const LeaderOf& leaderOf, bool sidesApart) {
    std::vector<std::uint32_t> numbers(count, ungrouped);
    std::unordered_map<std::uint32_t, std::uint32_t> numbersApart;
    Grouping groups;
    for (std::size_t v = 0; v < level.sources.size(); ++v) {
        const std::uint32_t leader = leaderOf(level.sources[v]);
        std::uint32_t& number = sidesApart && level.apart[v] != 0
                                    ? numbersApart.try_emplace(leader, ungrouped).first->second
                                    : numbers[leader];
        if (number == ungrouped) {
            number = static_cast<std::uint32_t>(groups.sources.size());
            groups.sources.push_back(leader);
        }
        groups.of.push_back(number);
    }
    return groups;
}

// The equations with every unknown's sums; solutions start at zero. `value` picks a VertexSums' values.
template <std::size_t channels, typename Value>
LeastSquares equations(const LevelMesh& level, const AnchorSums& sums, const Grouping& groups, const Value& value) {
    LeastSquares result;
    result.triangles = sums.triangles;
    result.corners.reserve(level.triangles.indices.size());
    for (const std::uint32_t v : level.triangles.indices) result.corners.push_back(groups.of[v]);
    std::vector<double> weights(groups.count(), 0);
    std::vector<std::array<double, channels>> targets(groups.count());
    for (std::size_t v = 0; v < groups.of.size(); ++v) {
        const std::uint32_t g = groups.of[v];
        weights[g] += sums.vertices[v].weight;
        for (std::size_t c = 0; c < channels; ++c) targets[g][c] += value(sums.vertices[v])[c];
    }
    result.weights.assign(weights.begin(), weights.end());
    result.sums.resize(groups.count());
    for (std::size_t g = 0; g < groups.count(); ++g)
        for (std::size_t c = 0; c < channels; ++c) result.sums[g][c] = static_cast<float>(targets[g][c]);
    result.solution.assign(groups.count(), LeastSquares::Row{});
    return result;
}

// Starts from the mean of what each unknown stands for; from `own(group)` where it stands for nothing.
template <std::size_t channels, typename Own>
void startFromMeans(LeastSquares& fit, const Own& own) {
    for (std::size_t g = 0; g < fit.weights.size(); ++g)
        for (std::size_t c = 0; c < channels; ++c)
            fit.solution[g][c] = fit.weights[g] > 0 ? fit.sums[g][c] / fit.weights[g] : own(g, c);
}

// Takes back what turned a triangle over, until none is: at worst everything.
void keepFacesUpright(std::vector<glm::vec3>& fitted, const std::vector<glm::vec3>& original,
                      const std::vector<std::uint32_t>& corners) {
    const auto normalOf = [&](const std::vector<glm::vec3>& points, std::size_t i) {
        const glm::dvec3 a = points[corners[i]];
        return glm::cross(glm::dvec3(points[corners[i + 1]]) - a, glm::dvec3(points[corners[i + 2]]) - a);
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const glm::dvec3 before = normalOf(original, i);
            const glm::dvec3 after = normalOf(fitted, i);
            if (glm::dot(before, after) >= leastFittedTurnCosine * glm::length(before) * glm::length(after)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t g = corners[i + k];
                changed |= fitted[g] != original[g];
                fitted[g] = original[g];
            }
        }
    }
}

std::vector<glm::vec3> fitPositions(const FitSource& source, const LevelMesh& level, const AnchorSums& sums) {
    const auto leaderOf = [&](std::uint32_t v) { return source.positions.first[source.positions.id[v]]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, false);
    auto fit = equations<3>(level, sums, groups, [](const VertexSums& v) { return v.gap; });
    fit.solve();
    std::vector<glm::vec3> original;
    original.reserve(groups.count());
    for (const std::uint32_t v : groups.sources) original.push_back(source.vertices.positions[v]);
    std::vector<glm::vec3> fitted = original;
    for (std::size_t g = 0; g < fitted.size(); ++g) {
        const auto& move = fit.solution[g];
        const glm::vec3 moved = original[g] + glm::vec3(move[0], move[1], move[2]);
        if (isFinite(moved))
            fitted[g] = glm::clamp(moved, glm::vec3(source.bounds.minimum), glm::vec3(source.bounds.maximum));
    }
    keepFacesUpright(fitted, original, fit.corners);
    std::vector<glm::vec3> positions;
    positions.reserve(groups.of.size());
    for (const std::uint32_t g : groups.of) positions.push_back(fitted[g]);
    return positions;
}

// Of the triangles around each group, weighed by their areas; zero where there are none.
std::vector<glm::dvec3> faceNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level,
                                    const Grouping& groups) {
    std::vector<glm::dvec3> sums(groups.count(), glm::dvec3(0));
    const std::vector<std::uint32_t>& indices = level.triangles.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a);
        for (std::size_t k = 0; k < 3; ++k) sums[groups.of[indices[i + k]]] += normal;
    }
    return sums;
}

// A fit that is no normal of the triangles around it, with their corners at `positions`, is replaced by theirs.
std::vector<glm::vec3> fitNormals(const FitSource& source, const LevelMesh& level, const AnchorSums& sums,
                                  const std::vector<glm::vec3>& positions) {
    // Fitted as vectors: their means are shorter than 1 where they differ.
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](std::uint32_t v) { return source.smoothing[v]; }, true);
    const std::vector<glm::vec3>& own = source.vertices.normals;
    auto fit = equations<3>(level, sums, groups, [](const VertexSums& v) { return v.normal; });
    startFromMeans<3>(fit, [&](std::size_t g, std::size_t c) { return own[groups.sources[g]][static_cast<int>(c)]; });
    fit.solve();

    const std::vector<glm::dvec3> faces = faceNormals(positions, level, groups);
    std::vector<glm::vec3> fitted;
    fitted.reserve(groups.of.size());
    for (std::size_t v = 0; v < groups.of.size(); ++v) {
        const auto& row = fit.solution[groups.of[v]];
        const glm::vec3 normal(row[0], row[1], row[2]);
        const float length = glm::length(normal);
        const glm::dvec3& face = faces[groups.of[v]];
        const double faceLength = glm::length(face);
        if (length > 0.1f && glm::dot(glm::dvec3(normal), face) >= 0)
            fitted.push_back(length > 1 ? normal / length : normal);
        else
            fitted.push_back(faceLength > 0 ? glm::vec3(face / faceLength) : own[level.sources[v]]);
    }
    return fitted;
}

std::vector<glm::u8vec4> fitColors(const FitSource& source, const LevelMesh& level, const AnchorSums& sums) {
    const std::vector<glm::u8vec4>& own = source.vertices.colors;
    if (own.empty()) return {};
    const Grouping groups = grouped(
        level, source.vertices.count(), [&](std::uint32_t v) { return source.shades[v]; }, true);
    auto fit = equations<4>(level, sums, groups, [](const VertexSums& v) { return v.color; });
    startFromMeans<4>(fit, [&](std::size_t g, std::size_t c) { return own[groups.sources[g]][static_cast<int>(c)]; });
    fit.solve();
    std::vector<glm::u8vec4> fitted(groups.of.size());
    for (std::size_t v = 0; v < fitted.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) {
            const float value = fit.solution[groups.of[v]][static_cast<std::size_t>(c)];
            fitted[v][c] =
                static_cast<std::uint8_t>(std::clamp(std::isfinite(value) ? std::round(value) : 0.0f, 0.0f, 255.0f));
        }
    return fitted;
}

}  // namespace

FitSource prepareFit(const Vertices& vertices, const Welded& positions, std::span<const std::uint32_t> smoothing,
                     std::span<const std::uint32_t> indices) {
    FitSource source{vertices, positions, smoothing, {}, {}, {}};
    source.shades = colorGroups(source.smoothing, vertices.colors);
    source.areas = vertexAreas(vertices.positions, indices);
    for (const std::uint32_t v : indices)
        if (isFinite(vertices.positions[v])) source.bounds.extend(glm::dvec3(vertices.positions[v]));
    return source;
}

LevelFit fitLevel(const FitSource& source, const LevelMesh& level, std::vector<Anchor> anchors) {
    const AnchorSums sums = sumAnchors(source, level, anchors);
    anchors = {};  // before what takes the most memory
    LevelFit fit;
    fit.positions = fitPositions(source, level, sums);
    fit.normals = fitNormals(source, level, sums, fit.positions);
    fit.colors = fitColors(source, level, sums);
    return fit;
}

}  // namespace defocus
