#pragma once
// Computes the data that the fits of a level's attributes share. An anchor (level_fit.h) is the point on the level's
// surface that represents vertices of level 0. The data include the area and the mean normal of the represented
// vertices, and the least-squares equations. These have one unknown per group of vertices with a common value. Private
// to level_fit.cpp and texture_fit.cpp.

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <unordered_map>
#include <vector>

#include "lod/simplify/least_squares.h"
#include "lod/simplify/level_fit.h"

namespace defocus::engine {

// Coordinates of a vertex in both UV sets; zero for a set that the mesh lacks.
struct Coordinates {
    glm::vec2 uv0{0};
    glm::vec2 uv1{0};
};

Coordinates coordinatesOf(const Vertices& vertices, MeshVertexNumber v);

// Total area and mean normal of the mesh vertices that one anchor (a point on the level) represents.
struct Anchored {
    float area = 0;
    glm::vec3 normal{0};  // area-weighted mean of the vertices' normals
};

// For each mesh vertex with an anchor (point on the level) of its own, the total area, mean normal and mean colour of
// all vertices that the anchor represents. Entries of other vertices are unused.
struct AnchoredValues {
    Numbered<MeshVertexNumber, Anchored> values;
    Numbered<MeshVertexNumber, glm::vec4> colors;  // area-weighted mean colours; empty if the mesh has none
};

AnchoredValues anchoredValues(const FitSource& source, const Numbered<MeshVertexNumber, Anchor>& anchors);

// Returns the unit normals of a level's triangles before the fit. `positions` are the positions of level 0's vertices.
// The normal of a triangle without area is zero.
Numbered<TriangleNumber, glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level);

// Returns the weight of an anchor (a point on the level's surface) in the fit: the projection of `area`, the area that
// the anchor represents, onto the anchor's triangle. The result is at least 2 % of `area`. `normal` is the normal of
// the represented surface; `face` is the unit normal of the triangle. Returns `area` itself if the triangle has no area
// or the anchor is at a corner, which belongs to several triangles.
float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal);

// Groups of the level's vertices. The vertices in one group share one value, which is one unknown of the equations.
struct Grouping {
    Numbered<LevelVertexNumber, UnknownNumber> of;
    // For each unknown, the mesh vertex that gives the initial value.
    Numbered<UnknownNumber, MeshVertexNumber> sources;
    [[nodiscard]] std::size_t count() const { return sources.size(); }

    // Returns, for each group, the sum of value(vertex) over its vertices, starting from `zero`.
    template <typename T, typename Value>
    [[nodiscard]] Numbered<UnknownNumber, T> summed(const T& zero, const Value& value) const {
        Numbered<UnknownNumber, T> sums(count(), zero);
        for (const LevelVertexNumber v : of.numbers()) addTo(sums[of[v]], value(v));
        return sums;
    }

private:
    static void addTo(double& sum, double value) { sum += value; }
    template <std::size_t n>
    static void addTo(std::array<double, n>& sum, const std::array<double, n>& value) {
        for (std::size_t c = 0; c < n; ++c) sum[c] += value[c];
    }
};

// Groups the level's vertices. leaderOf(v) returns the mesh vertex that represents the group of mesh vertex v, so
// vertices with the same leader form a group. `count` is the number of mesh vertices. With `sidesApart`, vertices on
// the back of a thin plate, such as a fin, are never grouped with vertices on the front (LevelMesh::apart).
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

// Returns least-squares equations with one unknown per group of vertices; the solution is initialised to zero. For
// vertex v of the level, weight(v) is the sum of the weights of its target points, and value(v) is the sum of the
// weighted targets.
template <std::size_t channels, typename Weight, typename Value>
LeastSquares equations(const LevelMesh& level, std::span<const TriangleSums> triangles, const Grouping& groups,
                       const Weight& weight, const Value& value) {
    LeastSquares result;
    result.triangles = triangles;
    result.corners.reserve(level.triangles.indices.size());
    for (const LevelVertexNumber v : level.triangles.indices) result.corners.push_back(groups.of[v]);
    result.weights.reserve(groups.count());
    for (const double sum : groups.summed(0.0, weight)) result.weights.push_back(static_cast<float>(sum));
    result.sums.reserve(groups.count());
    for (const auto& sum : groups.summed(std::array<double, channels>{}, value)) {
        LeastSquares::Row& row = result.sums.emplace_back(LeastSquares::Row{});
        for (std::size_t c = 0; c < channels; ++c) row[c] = static_cast<float>(sum[c]);
    }
    result.solution.assign(groups.count(), LeastSquares::Row{});
    return result;
}

// Initialises the unknown of each group of vertices to the weighted mean of its targets, or to own(group, channel) if
// the unknown has no targets.
template <std::size_t channels, typename Own>
void startFromMeans(LeastSquares& fit, const Own& own) {
    for (const UnknownNumber g : fit.weights.numbers())
        for (std::size_t c = 0; c < channels; ++c)
            fit.solution[g][c] = fit.weights[g] > 0 ? fit.sums[g][c] / fit.weights[g] : own(g, c);
}

// Fits uv0 and uv1 of `fit`, if the mesh has texture coordinates (texture_fit.cpp).
void fitCoordinates(const FitSource& source, const LevelMesh& level, const Numbered<MeshVertexNumber, Anchor>& anchors,
                    LevelFit& fit);

}  // namespace defocus::engine
