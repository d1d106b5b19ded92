#pragma once
// Stores triangle lists with three corners per triangle, sorted by primitive, and computes area-weighted means over
// their triangles.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "lod/simplify/number.h"
#include "lod/simplify/triangle.h"

namespace defocus::engine {

// `Vertex` is the type of the vertex numbers stored at the corners.
template <typename Vertex>
struct TriangleSet {
    Numbered<TriangleCorner, Vertex> indices;                       // three indices per triangle
    Numbered<PrimitiveNumber, std::uint32_t> primitiveIndexCounts;  // 3 × number of triangles of each primitive

    [[nodiscard]] std::size_t count() const { return indices.size() / 3; }
    [[nodiscard]] auto numbers() const { return numbersBelow<TriangleNumber>(count()); }
    [[nodiscard]] std::span<const Vertex, 3> corners(TriangleNumber t) const {
        return std::span<const Vertex, 3>(indices.data() + 3 * indexOf(t), 3);
    }
};

// Returns the index of each triangle's primitive.
template <typename Vertex>
Numbered<TriangleNumber, PrimitiveNumber> primitivesOf(const TriangleSet<Vertex>& triangles) {
    Numbered<TriangleNumber, PrimitiveNumber> primitives;
    primitives.reserve(triangles.count());
    for (const PrimitiveNumber p : triangles.primitiveIndexCounts.numbers())
        primitives.insert(primitives.end(), triangles.primitiveIndexCounts[p] / 3, p);
    return primitives;
}

// Returns the area-weighted mean of a function that is linear over each triangle and has the value value(v) at corner
// v. at(v) is the position of the corner. Returns 0 if the surface has no area.
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

// Returns the vertex numbers at the corners as plain integers.
template <typename Vertex>
std::vector<std::uint32_t> plainCorners(const TriangleSet<Vertex>& triangles) {
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.indices.size());
    for (const Vertex v : triangles.indices) corners.push_back(v.value);
    return corners;
}

}  // namespace defocus::engine
