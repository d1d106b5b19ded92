#include "lod/simplify/fit_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace defocus::engine {

namespace {

// Lower and upper bound of the area that a vertex represents, relative to the mean area. They keep the equations
// well-conditioned.
constexpr double minArea = 1e-3;
constexpr double largestArea = 1e3;

// Groups the vertices 0 … `count` − 1 that have equal keys and equal values. Keys are below `keyCount`.
template <typename Key, typename KeyOf, typename ValuesOf>
VertexGroups equalGroups(std::size_t count, std::size_t keyCount, const KeyOf& keyOf, const ValuesOf& valuesOf) {
    struct Member {
        std::array<std::uint32_t, 4> values;
        MeshVertexNumber vertex;
        auto operator<=>(const Member&) const = default;
    };
    VertexGroups groups;
    groups.reserve(count);
    for (const auto v : numbersBelow<MeshVertexNumber>(count)) groups.push_back(v);
    const Buckets<Key, MeshVertexNumber> buckets(keyCount, count, keyOf);
    std::vector<Member> members;
    for (const Key key : buckets.keys()) {
        if (buckets[key].size() < 2) continue;
        members.clear();
        for (const MeshVertexNumber v : buckets[key]) {
            Member& member = members.emplace_back();
            member.vertex = v;
            const std::array<float, 4> values = valuesOf(v);
            for (std::size_t i = 0; i < 4; ++i)
                member.values[i] = std::bit_cast<std::uint32_t>(values[i] + 0.0f);  // −0 becomes 0
        }
        std::sort(members.begin(), members.end());
        for (std::size_t i = 1; i < members.size(); ++i)
            if (members[i].values == members[i - 1].values) groups[members[i].vertex] = groups[members[i - 1].vertex];
    }
    return groups;
}

// Splits groups of vertices that share a normal, so that the vertices in each group also share a colour.
VertexGroups colorGroups(const VertexGroups& smoothing, const std::vector<glm::vec4>& colors) {
    if (colors.empty()) return {};
    return equalGroups<MeshVertexNumber>(
        colors.size(), colors.size(), [&](MeshVertexNumber v) { return smoothing[v]; },
        [&](MeshVertexNumber v) {
            const glm::vec4& c = colors[v.value];
            return std::array{c.r, c.g, c.b, c.a};
        });
}

// Groups vertices with the same position and the same texture coordinates.
VertexGroups chartGroups(const Vertices& vertices, const WeldedPositions& positions) {
    if (vertices.uv0.empty() && vertices.uv1.empty()) return {};
    return equalGroups<PositionNumber>(
        vertices.count(), positions.first.size(), [&](MeshVertexNumber v) { return positions.id[v]; },
        [&](MeshVertexNumber v) {
            const auto [uv0, uv1] = coordinatesOf(vertices, v);
            return std::array{uv0.x, uv0.y, uv1.x, uv1.y};
        });
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
        relative[v] = static_cast<float>(std::clamp(areas[v] / mean, minArea, largestArea));
    return relative;
}

// Min fraction of the area around a vertex that counts in a fit, even if the vertex normal is perpendicular to the
// normal of the level's triangle.
constexpr float minForeshortening = 0.02f;
// Two vertices that share an anchor (a point on the level's surface) are on different sides of a sharp edge if their
// normals differ by more than 60°.
constexpr float minSharedCosine = 0.5f;

}  // namespace

Coordinates coordinatesOf(const Vertices& vertices, MeshVertexNumber v) {
    Coordinates result;
    if (!vertices.uv0.empty()) result.uv0 = vertices.uv0[v.value];
    if (!vertices.uv1.empty()) result.uv1 = vertices.uv1[v.value];
    return result;
}

FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles) {
    FitSource source{vertices, positions, smoothing, {}, {}, {}, {}, {}, glm::dvec4(0), {}, {}};
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
    source.light = lightMeans({vertices.positions, vertices.normals, vertices.colors, corners, false}, pointsOfLight);
    return source;
}

AnchoredValues anchoredValues(const FitSource& source, const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Vertices& vertices = source.vertices;
    AnchoredValues sums;
    sums.values.resize(anchors.size());
    if (!vertices.colors.empty()) sums.colors.resize(anchors.size(), glm::vec4(0));
    for (const MeshVertexNumber v : anchors.numbers()) {
        const MeshVertexNumber other = anchors[v].shared();
        const MeshVertexNumber own = other.isValid() ? other : v;
        Anchored& sum = sums.values[own];
        sum.area += source.areas[v];
        const glm::vec3& normal = vertices.normals[v.value];
        const glm::vec3& shared = vertices.normals[own.value];
        const bool acrossEdge = glm::dot(normal, shared) < minSharedCosine;
        sum.normal += source.areas[v] * (acrossEdge ? shared : normal);
        if (!sums.colors.empty()) sums.colors[own] += source.areas[v] * vertices.colors[v.value];
    }
    for (const MeshVertexNumber v : sums.values.numbers()) {
        Anchored& sum = sums.values[v];
        if (!(sum.area > 0)) continue;
        sum.normal /= sum.area;
        if (!sums.colors.empty()) sums.colors[v] /= sum.area;
    }
    return sums;
}

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

float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal) {
    const float* w = anchor.weight;
    const bool atCorner = w[0] == 1 || w[1] == 1 || w[2] == 1;
    if (atCorner || face == glm::vec3(0)) return area;
    return area * std::clamp(glm::dot(face, normal), minForeshortening, 1.0f);
}

}  // namespace defocus::engine
