#include "lod/level_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "lod/smoothing_groups.h"

namespace defocus {

namespace {

constexpr int iterations = 12;
// Pull towards the mean of what a vertex stands for, as a share of its weight: keeps vertices with few anchors from
// overshooting.
constexpr float pull = 0.01f;

template <std::size_t channels>
using Row = std::array<float, channels>;

// Least squares over groups of vertices: minimises Σ |Σ weight·x − target|² + pull·Σ weightOf·|x − mean|².
template <std::size_t channels>
class Fit {
public:
    Fit(const std::vector<std::uint32_t>& groups, std::span<const Anchor> anchors,
        const std::vector<Row<channels>>& targets)
        : groups_(groups), anchors_(anchors), weight_(targets.size(), 0), diagonal_(targets.size(), 0), mean_(targets) {
        std::vector<Row<channels>> sums(targets.size());
        for (std::size_t i = 0; i < anchors.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const float w = anchors[i].weight[k];
                const std::uint32_t g = groups[anchors[i].vertex[k]];
                weight_[g] += w;
                diagonal_[g] += w * w;
                for (std::size_t c = 0; c < channels; ++c) sums[g][c] += w * targets[i][c];
            }
        for (std::size_t g = 0; g < targets.size(); ++g) {
            if (!(weight_[g] > 0)) continue;
            for (std::size_t c = 0; c < channels; ++c) mean_[g][c] = sums[g][c] / weight_[g];
            diagonal_[g] += pull * weight_[g];
        }
        // Start from the means; the residual of the normal equations there.
        solution_ = mean_;
        residual_ = applied(solution_);
        for (std::size_t g = 0; g < targets.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c)
                residual_[g][c] = sums[g][c] + pull * weight_[g] * mean_[g][c] - residual_[g][c];
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
        for (const Anchor& anchor : anchors_) {
            Row<channels> value{};
            for (int k = 0; k < 3; ++k)
                for (std::size_t c = 0; c < channels; ++c)
                    value[c] += anchor.weight[k] * x[groups_[anchor.vertex[k]]][c];
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
    std::vector<float> weight_;
    std::vector<float> diagonal_;
    std::vector<Row<channels>> mean_;
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

}  // namespace

LevelAttributes fitAttributes(const Vertices& vertices, const std::vector<std::uint32_t>& positions,
                              std::span<const Anchor> anchors) {
    LevelAttributes result;
    const std::vector<std::uint32_t> smoothing = smoothingGroups(vertices.normals, positions);

    // Normals, fitted as vectors: their means are shorter than 1 where they differ.
    std::vector<Row<3>> normals(vertices.count());
    for (std::size_t v = 0; v < normals.size(); ++v)
        normals[v] = {vertices.normals[v].x, vertices.normals[v].y, vertices.normals[v].z};
    Fit<3> normalFit(smoothing, anchors, normals);
    const std::vector<Row<3>>& fittedNormals = normalFit.solve();
    result.normals.resize(vertices.count());
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const Row<3>& fitted = fittedNormals[smoothing[v]];
        const glm::vec3 normal(fitted[0], fitted[1], fitted[2]);
        const float length = glm::length(normal);
        const bool sound = std::isfinite(length) && length > 0.1f && glm::dot(normal, vertices.normals[v]) > 0;
        result.normals[v] = !sound ? vertices.normals[v] : length > 1 ? normal / length : normal;
    }

    if (vertices.colors.empty()) return result;
    const std::vector<std::uint32_t> alike = colorGroups(smoothing, vertices.colors);
    std::vector<Row<4>> colors(vertices.count());
    for (std::size_t v = 0; v < colors.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) colors[v][static_cast<std::size_t>(c)] = vertices.colors[v][c];
    Fit<4> colorFit(alike, anchors, colors);
    const std::vector<Row<4>>& fittedColors = colorFit.solve();
    result.colors.resize(vertices.count());
    for (std::size_t v = 0; v < colors.size(); ++v)
        for (glm::length_t c = 0; c < 4; ++c) {
            const float value = fittedColors[alike[v]][static_cast<std::size_t>(c)];
            result.colors[v][c] =
                static_cast<std::uint8_t>(std::clamp(std::isfinite(value) ? std::round(value) : 0.0f, 0.0f, 255.0f));
        }
    return result;
}

}  // namespace defocus
