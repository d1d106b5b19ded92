#pragma once
// Builds small meshes with seams and borders as in real files. Functions that count faces or edges treat vertices at
// the same position as one vertex.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

using PositionKey = std::tuple<float, float, float>;

inline PositionKey keyOf(const glm::vec3& p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

inline Mesh singlePrimitive(Vertices vertices, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.name = "test";
    mesh.vertices = std::move(vertices);
    mesh.primitives.push_back({-1, std::move(indices)});
    if (mesh.vertices.normals.empty())
        mesh.vertices.normals = smoothNormals(mesh.vertices.positions, mesh.primitives[0].indices);
    return mesh;
}

// Returns columns × rows quads of two triangles each, with (columns + 1)·(rows + 1) vertices at the positions `place(i,
// j)`. If `place` closes the surface, the vertices at both ends stay separate, as at a UV seam. Triangles with
// coincident corners, as at poles, are omitted.
template <typename Place>
Mesh parametricSurface(std::uint32_t columns, std::uint32_t rows, const Place& place) {
    Vertices vertices;
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i) {
            // If the surface is closed, `place` returns bit-identical positions for the first and the last column or
            // row.
            vertices.positions.push_back(glm::vec3(place(i, j)));
            vertices.uv0.push_back({static_cast<float>(i) / static_cast<float>(columns),
                                    static_cast<float>(j) / static_cast<float>(rows)});
        }
    std::vector<std::uint32_t> indices;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& p = vertices.positions;
        if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
        for (const std::uint32_t v : {a, b, c}) indices.push_back(v);
    };
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i;
            const std::uint32_t b = a + columns + 1;
            add(a, a + 1, b + 1);
            add(a, b + 1, b);
        }
    return singlePrimitive(std::move(vertices), std::move(indices));
}

inline double turn(std::uint32_t i, std::uint32_t count) {
    return 2 * std::numbers::pi * (i % count) / count;
}

// Returns a unit sphere with a UV seam and one pole vertex per column. `bump` is the height of its bumps.
inline Mesh sphere(std::uint32_t columns, std::uint32_t rows, double bump = 0) {
    return parametricSurface(columns, rows, [=](std::uint32_t i, std::uint32_t j) {
        if (j == 0 || j == rows) return glm::dvec3(0, 0, j == 0 ? -1 : 1);
        const double a = turn(i, columns);
        const double b = std::numbers::pi * j / rows;
        const double r = 1 + bump * std::sin(7 * a) * std::sin(9 * b) * std::sin(b);
        return r * glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
    });
}

// Returns a torus of radii 1 and 0.4 with UV seams in both directions.
inline Mesh torus(std::uint32_t columns, std::uint32_t rows) {
    return parametricSurface(columns, rows, [=](std::uint32_t i, std::uint32_t j) {
        const double a = turn(i, columns);
        const double b = turn(j, rows);
        const double r = 1 + 0.4 * std::cos(b);
        return glm::dvec3(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
    });
}

// Returns the mesh with tangents, a second set of texture coordinates, and colours and joints that differ between
// vertices at the same position.
inline Mesh decorated(Mesh mesh) {
    const std::size_t count = mesh.vertices.count();
    for (std::size_t v = 0; v < count; ++v) {
        const auto byte = static_cast<std::uint8_t>(v % 251);
        mesh.vertices.tangents.push_back({1, 0, 0, v % 2 == 0 ? 1.0f : -1.0f});
        mesh.vertices.uv1.push_back(0.5f * mesh.vertices.uv0[v]);
        mesh.vertices.colors.emplace_back(byte / 255.0f, 0.5f, 1, 1);
        mesh.vertices.joints.push_back({byte, 0, 0, 0});
        mesh.vertices.weights.push_back({1, 0, 0, 0});
    }
    return mesh;
}

// Returns the unit square at z = 0 in `cells` × `cells` quads.
inline Mesh flatGrid(std::uint32_t cells) {
    return parametricSurface(cells, cells, [=](std::uint32_t i, std::uint32_t j) {
        return glm::dvec3(static_cast<double>(i) / cells, static_cast<double>(j) / cells, 0);
    });
}

// Returns a closed slab with a row of `holes` square holes along x, so its genus is `holes`. Each side of a hole has
// `cells` quads.
inline Mesh slab(std::uint32_t holes, int cells) {
    const int columns = 2 * static_cast<int>(holes) + 1;
    const auto solid = [&](int i, int j) {
        return i >= 0 && j >= 0 && i < cells * columns && j < 3 * cells && !(i / cells % 2 == 1 && j / cells == 1);
    };
    Vertices vertices;
    std::vector<std::uint32_t> indices;
    const auto addQuad = [&](const glm::ivec3& at, const glm::ivec3& u, const glm::ivec3& v) {
        const auto first = static_cast<std::uint32_t>(vertices.positions.size());
        for (const glm::ivec3& corner : {at, at + u, at + u + v, at + v})
            vertices.positions.push_back(glm::vec3(corner) / static_cast<float>(cells * columns));
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + corner);
    };
    const glm::ivec3 x(1, 0, 0);
    const glm::ivec3 y(0, 1, 0);
    const glm::ivec3 z(0, 0, 1);
    for (int i = 0; i < cells * columns; ++i)
        for (int j = 0; j < 3 * cells; ++j) {
            if (!solid(i, j)) continue;
            addQuad({i, j, cells}, x, y);
            addQuad({i, j, 0}, y, x);
            for (int k = 0; k < cells; ++k) {
                if (!solid(i - 1, j)) addQuad({i, j, k}, z, y);
                if (!solid(i + 1, j)) addQuad({i + 1, j, k}, y, z);
                if (!solid(i, j - 1)) addQuad({i, j, k}, x, z);
                if (!solid(i, j + 1)) addQuad({i, j + 1, k}, z, x);
            }
        }
    return singlePrimitive(std::move(vertices), std::move(indices));
}

inline void addPart(Mesh& mesh, const Mesh& part, float scale, const glm::vec3& place) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.count());
    for (const glm::vec3& p : part.vertices.positions) mesh.vertices.positions.push_back(place + scale * p);
    const auto& normals = part.vertices.normals;
    mesh.vertices.normals.insert(mesh.vertices.normals.end(), normals.begin(), normals.end());
    if (mesh.primitives.empty()) mesh.primitives.push_back({-1, {}});
    for (const std::uint32_t v : part.primitives[0].indices) mesh.primitives[0].indices.push_back(first + v);
}

inline std::vector<std::uint32_t> levelIndices(const Pyramid& pyramid, std::size_t level) {
    std::vector<std::uint32_t> indices;
    for (const IndexRange& range : pyramid.levels[level].primitives) {
        const auto begin = pyramid.indices.begin() + static_cast<std::ptrdiff_t>(range.first);
        indices.insert(indices.end(), begin, begin + static_cast<std::ptrdiff_t>(range.count));
    }
    return indices;
}

// Number of faces at an undirected edge, and their `balance`: the number of faces that use the edge forwards minus the
// number that use it backwards. Vertices at the same position count as one.
struct EdgeUse {
    int balance = 0;
    int count = 0;
};

inline std::map<std::pair<PositionKey, PositionKey>, EdgeUse> edgeUses(const std::vector<glm::vec3>& positions,
                                                                       const std::vector<std::uint32_t>& indices) {
    std::map<std::pair<PositionKey, PositionKey>, EdgeUse> edges;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const PositionKey a = keyOf(positions[indices[i + k]]);
            const PositionKey b = keyOf(positions[indices[i + (k + 1) % 3]]);
            EdgeUse& use = edges[{std::min(a, b), std::max(a, b)}];
            use.balance += a < b ? 1 : -1;
            ++use.count;
        }
    return edges;
}

// Returns whether each edge has exactly two faces, one in each direction. Vertices at the same position are joined.
inline bool isClosed(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
    const auto edges = edgeUses(positions, indices);
    return std::all_of(edges.begin(), edges.end(),
                       [](const auto& edge) { return edge.second.count == 2 && edge.second.balance == 0; });
}

// Returns the index, from 0, of each vertex's connected part. Vertices at the same position are connected.
inline std::vector<std::uint32_t> partsByPosition(const Mesh& mesh) {
    std::map<PositionKey, std::uint32_t> ids;
    std::vector<std::uint32_t> places;
    for (const glm::vec3& p : mesh.vertices.positions)
        places.push_back(ids.try_emplace(keyOf(p), static_cast<std::uint32_t>(ids.size())).first->second);
    std::vector<std::uint32_t> parents(ids.size());
    for (std::uint32_t v = 0; v < parents.size(); ++v) parents[v] = v;
    const auto root = [&](std::uint32_t v) {
        while (parents[v] != v) v = parents[v] = parents[parents[v]];
        return v;
    };
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
            for (const std::size_t k : {i + 1, i + 2})
                parents[root(places[primitive.indices[k]])] = root(places[primitive.indices[i]]);
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (std::uint32_t& place : places)
        place = numbers.try_emplace(root(place), static_cast<std::uint32_t>(numbers.size())).first->second;
    return places;
}

// Returns the triangles as a sorted list of corner positions. Each triangle starts with its smallest corner, so equal
// sets of triangles give equal results.
inline std::vector<std::array<PositionKey, 3>> triangleSet(const std::vector<glm::vec3>& positions,
                                                           const std::vector<std::uint32_t>& indices) {
    std::vector<std::array<PositionKey, 3>> result;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<PositionKey, 3> corners = {keyOf(positions[indices[i]]), keyOf(positions[indices[i + 1]]),
                                              keyOf(positions[indices[i + 2]])};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        result.push_back(corners);
    }
    std::sort(result.begin(), result.end());
    return result;
}

inline double surfaceArea(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
    double area = 0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        area += 0.5 * glm::length(glm::cross(glm::dvec3(positions[indices[i + 1]]) - a,
                                             glm::dvec3(positions[indices[i + 2]]) - a));
    }
    return area;
}

// Returns a position for part `i` of a mesh. The first n positions, for any n, are evenly spread over the unit square
// (Roberts 2018).
inline glm::vec3 scatteredPlace(std::uint32_t i) {
    return {static_cast<float>(std::fmod(0.5 + 0.7548776662466927 * i, 1.0)),
            static_cast<float>(std::fmod(0.5 + 0.5698402909980532 * i, 1.0)), 0};
}

// Returns a square sheet of thickness 0.004. Its front, back and rim share smooth normals, as in scans and sculpted
// fins.
inline Mesh thinSheet(std::uint32_t cells) {
    Mesh mesh = parametricSurface(2 * cells + 2, cells, [=](std::uint32_t i, std::uint32_t j) {
        const std::uint32_t around = i % (2 * cells + 2);
        const bool front = around <= cells;
        const double x = front ? around : 2.0 * cells + 1 - around;
        return glm::dvec3(x / cells, static_cast<double>(j) / cells, front ? 0.002 : -0.002);
    });
    mesh.vertices.normals = smoothNormals(mesh.vertices.positions, mesh.primitives[0].indices);
    return mesh;
}

}  // namespace defocus::engine
