#include "lod/level_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "core/bounds.h"
#include "lod/smoothing_groups.h"

namespace defocus {

namespace {

constexpr int iterations = 4;  // more change nothing that can be seen
// Pull towards the prior, as a share of a vertex's weight: keeps vertices with few anchors from overshooting.
constexpr float pull = 0.01f;
// Bounds of a vertex's area, in means of all: they keep the equations well conditioned.
constexpr double leastArea = 1e-3;
constexpr double largestArea = 1e3;
// A vertex whose normal stands square to its face's counts this much of its area.
constexpr double leastForeshortening = 0.02;
// A fitted face that is turned by more than 60° goes back to where it was.
constexpr double leastFittedTurnCosine = 0.5;

template <std::size_t channels>
using Row = std::array<float, channels>;

enum class Prior { mean, zero };  // of what a vertex stands for

// Least squares over groups of vertices: minimises Σ share·|Σ weight·x − target|² + pull·Σ weightOf·|x − prior|².
template <std::size_t channels>
class LeastSquares {
public:
    LeastSquares(const std::vector<std::uint32_t>& groups, std::span<const Anchor> anchors,
                 const std::vector<float>& shares, const std::vector<Row<channels>>& targets, Prior prior)
        : groups_(groups),
          anchors_(anchors),
          shares_(shares),
          weight_(targets.size(), 0),
          diagonal_(targets.size(), 0) {
        std::vector<Row<channels>> sums(targets.size());
        for (std::size_t i = 0; i < anchors.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const float w = shares[i] * anchors[i].weight[k];
                const std::uint32_t g = groups[anchors[i].vertex[k]];
                weight_[g] += w;
                diagonal_[g] += w * anchors[i].weight[k];
                for (std::size_t c = 0; c < channels; ++c) sums[g][c] += w * targets[i][c];
            }
        // Start from the prior; the residual of the normal equations there.
        solution_ = targets;  // of groups without an anchor
        for (std::size_t g = 0; g < targets.size(); ++g) {
            if (prior == Prior::zero) solution_[g] = {};
            if (!(weight_[g] > 0)) continue;
            if (prior == Prior::mean)
                for (std::size_t c = 0; c < channels; ++c) solution_[g][c] = sums[g][c] / weight_[g];
            diagonal_[g] += pull * weight_[g];
        }
        residual_ = applied(solution_);
        for (std::size_t g = 0; g < targets.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c)
                residual_[g][c] = sums[g][c] + pull * weight_[g] * solution_[g][c] - residual_[g][c];
    }

    const std::vector<Row<channels>>& solve() {
        std::vector<Row<channels>> direction = preconditioned();
        Row<channels> energy = dot(residual_, direction);
        for (int iteration = 0; iteration < iterations; ++iteration) {
            const std::vector<Row<channels>> image = applied(direction);
            const Row<channels> curvature = dot(direction, image);
            Row<channels> step{};
            for (std::size_t c = 0; c < channels; ++c) step[c] = curvature[c] > 0 ? energy[c] / curvature[c] : 0;
            for (std::size_t g = 0; g < solution_.size(); ++g)
                for (std::size_t c = 0; c < channels; ++c) {
                    solution_[g][c] += step[c] * direction[g][c];
                    residual_[g][c] -= step[c] * image[g][c];
                }
            const std::vector<Row<channels>> next = preconditioned();
            const Row<channels> nextEnergy = dot(residual_, next);
            for (std::size_t g = 0; g < solution_.size(); ++g)
                for (std::size_t c = 0; c < channels; ++c)
                    direction[g][c] = next[g][c] + (energy[c] > 0 ? nextEnergy[c] / energy[c] : 0) * direction[g][c];
            energy = nextEnergy;
        }
        return solution_;
    }

private:
    // The normal equations' matrix times `x`.
    std::vector<Row<channels>> applied(const std::vector<Row<channels>>& x) const {
        std::vector<Row<channels>> result(x.size());
        for (std::size_t i = 0; i < anchors_.size(); ++i) {
            const Anchor& anchor = anchors_[i];
            Row<channels> value{};
            for (int k = 0; k < 3; ++k)
                for (std::size_t c = 0; c < channels; ++c)
                    value[c] += shares_[i] * anchor.weight[k] * x[groups_[anchor.vertex[k]]][c];
            for (int k = 0; k < 3; ++k)
                for (std::size_t c = 0; c < channels; ++c)
                    result[groups_[anchor.vertex[k]]][c] += anchor.weight[k] * value[c];
        }
        for (std::size_t g = 0; g < x.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c) result[g][c] += pull * weight_[g] * x[g][c];
        return result;
    }

    std::vector<Row<channels>> preconditioned() const {
        std::vector<Row<channels>> result = residual_;
        for (std::size_t g = 0; g < result.size(); ++g)
            for (float& value : result[g]) value = diagonal_[g] > 0 ? value / diagonal_[g] : 0;
        return result;
    }

    static Row<channels> dot(const std::vector<Row<channels>>& a, const std::vector<Row<channels>>& b) {
        std::array<double, channels> sums{};
        for (std::size_t g = 0; g < a.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c) sums[c] += double{a[g][c]} * double{b[g][c]};
        Row<channels> result;
        std::copy(sums.begin(), sums.end(), result.begin());
        return result;
    }

    const std::vector<std::uint32_t>& groups_;
    std::span<const Anchor> anchors_;
    const std::vector<float>& shares_;
    std::vector<float> weight_;
    std::vector<float> diagonal_;
    std::vector<Row<channels>> solution_;
    std::vector<Row<channels>> residual_;
};

// Within the smoothing groups, vertices of one colour.
std::vector<std::uint32_t> colorGroups(const std::vector<std::uint32_t>& smoothing,
                                       const std::vector<glm::u8vec4>& colors) {
    std::map<std::array<std::uint32_t, 5>, std::uint32_t> leaders;
    std::vector<std::uint32_t> groups(smoothing.size());
    for (std::uint32_t v = 0; v < smoothing.size(); ++v) {
        const glm::u8vec4& c = colors[v];
        groups[v] = leaders.try_emplace({smoothing[v], c.r, c.g, c.b, c.a}, v).first->second;
    }
    return groups;
}

// How much of its face each anchored vertex stands for, seen straight on: its area, foreshortened.
std::vector<float> projectedShares(const Vertices& vertices, std::span<const Anchor> anchors,
                                   const std::vector<float>& areas) {
    std::vector<float> shares = areas;
    for (std::size_t v = 0; v < anchors.size(); ++v) {
        const std::uint32_t* corner = anchors[v].vertex;
        const glm::dvec3 a = vertices.positions[corner[0]];
        const glm::dvec3 face =
            glm::cross(glm::dvec3(vertices.positions[corner[1]]) - a, glm::dvec3(vertices.positions[corner[2]]) - a);
        const double length = glm::length(face);
        if (!(length > 0)) continue;
        const double cosine = glm::dot(face, glm::dvec3(vertices.normals[v])) / length;
        shares[v] *= static_cast<float>(std::clamp(cosine, leastForeshortening, 1.0));
    }
    return shares;
}

// Takes back what turned a face over, until no face is: at worst everything.
void keepFacesUpright(std::vector<glm::vec3>& fitted, const std::vector<glm::vec3>& original,
                      const std::vector<std::uint32_t>& groups, std::span<const std::uint32_t> indices) {
    const auto normalOf = [&](const std::vector<glm::vec3>& points, std::size_t i) {
        const glm::dvec3 a = points[groups[indices[i]]];
        return glm::cross(glm::dvec3(points[groups[indices[i + 1]]]) - a,
                          glm::dvec3(points[groups[indices[i + 2]]]) - a);
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::dvec3 before = normalOf(original, i);
            const glm::dvec3 after = normalOf(fitted, i);
            if (glm::dot(before, after) >= leastFittedTurnCosine * glm::length(before) * glm::length(after)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t g = groups[indices[i + k]];
                changed |= fitted[g] != original[g];
                fitted[g] = original[g];
            }
        }
    }
}

std::vector<glm::vec3> fitPositions(const std::vector<glm::vec3>& positions, const Welded& welded,
                                    std::span<const Anchor> anchors, const std::vector<float>& shares,
                                    std::span<const std::uint32_t> indices, const Bounds& bounds) {
    std::vector<std::uint32_t> groups(positions.size());
    for (std::size_t v = 0; v < groups.size(); ++v) groups[v] = welded.first[welded.id[v]];

    // Fit displacements: they are small, so that single precision does far from the origin too.
    std::vector<Row<3>> gaps(positions.size());
    for (std::size_t v = 0; v < anchors.size(); ++v) {
        glm::dvec3 onLevel(0);
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
            onLevel += double{anchors[v].weight[k]} * glm::dvec3(positions[anchors[v].vertex[k]]);
            sum += anchors[v].weight[k];
        }
        const glm::vec3 gap(glm::dvec3(positions[v]) - onLevel);
        if (sum > 0) gaps[v] = {gap.x, gap.y, gap.z};
    }
    LeastSquares<3> fit(groups, anchors, shares, gaps, Prior::zero);
    const std::vector<Row<3>>& moves = fit.solve();

    std::vector<glm::vec3> fitted = positions;
    for (std::size_t v = 0; v < fitted.size(); ++v) {
        const Row<3>& move = moves[groups[v]];
        const glm::vec3 moved = positions[groups[v]] + glm::vec3(move[0], move[1], move[2]);
        if (isFinite(moved)) fitted[v] = glm::clamp(moved, glm::vec3(bounds.minimum), glm::vec3(bounds.maximum));
    }
    keepFacesUpright(fitted, positions, groups, indices);
    for (std::size_t v = 0; v < fitted.size(); ++v) fitted[v] = fitted[groups[v]];
    return fitted;
}

// Of the faces around each group, weighed by their areas; zero where there are none.
std::vector<glm::dvec3> faceNormals(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& groups,
                                    std::span<const std::uint32_t> indices) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a);
        for (std::size_t k = 0; k < 3; ++k) sums[groups[indices[i + k]]] += normal;
    }
    return sums;
}

// `faces` are the level's faceNormals(): a fit that is no normal of theirs is replaced by theirs.
std::vector<glm::vec3> fitNormals(const std::vector<glm::vec3>& normals, const std::vector<std::uint32_t>& smoothing,
                                  std::span<const Anchor> anchors, const std::vector<float>& shares,
                                  const std::vector<glm::dvec3>& faces) {
    // Fitted as vectors: their means are shorter than 1 where they differ.
    std::vector<Row<3>> targets(normals.size());
    for (std::size_t v = 0; v < normals.size(); ++v) targets[v] = {normals[v].x, normals[v].y, normals[v].z};
    LeastSquares<3> fit(smoothing, anchors, shares, targets, Prior::mean);
    const std::vector<Row<3>>& solution = fit.solve();
    std::vector<glm::vec3> fitted(normals.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const Row<3>& row = solution[smoothing[v]];
        const glm::vec3 normal(row[0], row[1], row[2]);
        const float length = glm::length(normal);
        const glm::dvec3& face = faces[smoothing[v]];
        const double faceLength = glm::length(face);
        if (length > 0.1f && glm::dot(glm::dvec3(normal), face) >= 0)
            fitted[v] = length > 1 ? normal / length : normal;
        else
            fitted[v] = faceLength > 0 ? glm::vec3(face / faceLength) : normals[v];
    }
    return fitted;
}

std::vector<glm::u8vec4> fitColors(const std::vector<glm::u8vec4>& colors, const std::vector<std::uint32_t>& smoothing,
                                   std::span<const Anchor> anchors, const std::vector<float>& shares) {
    if (colors.empty()) return {};
    const std::vector<std::uint32_t> alike = colorGroups(smoothing, colors);
    std::vector<Row<4>> targets(colors.size());
    for (std::size_t v = 0; v < colors.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) targets[v][static_cast<std::size_t>(c)] = colors[v][c];
    LeastSquares<4> fit(alike, anchors, shares, targets, Prior::mean);
    const std::vector<Row<4>>& solution = fit.solve();
    std::vector<glm::u8vec4> fitted(colors.size());
    for (std::size_t v = 0; v < colors.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) {
            const float value = solution[alike[v]][static_cast<std::size_t>(c)];
            fitted[v][c] =
                static_cast<std::uint8_t>(std::clamp(std::isfinite(value) ? std::round(value) : 0.0f, 0.0f, 255.0f));
        }
    return fitted;
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

}  // namespace

FitSource prepareFit(const Vertices& vertices, const Welded& positions, std::size_t ownCount,
                     std::span<const std::uint32_t> indices) {
    FitSource source{vertices,
                     positions,
                     smoothingGroups(vertices.normals, positions.id),
                     vertexAreas(vertices.positions, indices),
                     {}};
    for (const std::uint32_t v : indices)
        if (isFinite(vertices.positions[v])) source.bounds.extend(glm::dvec3(vertices.positions[v]));
    for (std::size_t v = ownCount; v < source.smoothing.size(); ++v)
        source.smoothing[v] = static_cast<std::uint32_t>(v);
    return source;
}

LevelFit fitLevel(const FitSource& source, std::span<const Anchor> anchors, std::span<const std::uint32_t> indices) {
    const Vertices& vertices = source.vertices;
    const std::vector<float> shares = projectedShares(vertices, anchors, source.areas);
    LevelFit fit;
    fit.positions = fitPositions(vertices.positions, source.positions, anchors, shares, indices, source.bounds);
    fit.normals = fitNormals(vertices.normals, source.smoothing, anchors, shares,
                             faceNormals(fit.positions, source.smoothing, indices));
    fit.colors = fitColors(vertices.colors, source.smoothing, anchors, shares);
    return fit;
}

}  // namespace defocus
