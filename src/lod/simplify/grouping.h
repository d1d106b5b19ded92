#pragma once
// The unknowns of a level's fit: groups of its vertices that share a value, and their equations.

#include <array>
#include <cstddef>
#include <unordered_map>

#include "lod/simplify/least_squares.h"
#include "lod/simplify/level_fit.h"

namespace defocus {

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

// Starts each unknown from the mean of what it stands for, or from own(group, channel) if it stands for nothing.
template <std::size_t channels, typename Own>
void startFromMeans(LeastSquares& fit, const Own& own) {
    for (const UnknownNumber g : fit.weights.numbers())
        for (std::size_t c = 0; c < channels; ++c)
            fit.solution[g][c] = fit.weights[g] > 0 ? fit.sums[g][c] / fit.weights[g] : own(g, c);
}

}  // namespace defocus
