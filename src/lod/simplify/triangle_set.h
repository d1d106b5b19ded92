#pragma once
// Triangles in the form that all of `lod` passes on, primitive after primitive with three corners each, and means over
// their area.

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

// `Vertex` says whose numbers the corners hold.
template <typename Vertex>
struct TriangleSet {
    Numbered<TriangleCorner, Vertex> indices;                       // three a triangle
    Numbered<PrimitiveNumber, std::uint32_t> primitiveIndexCounts;  // three for each triangle of a primitive

    [[nodiscard]] std::size_t count() const { return indices.size() / 3; }
    [[nodiscard]] auto numbers() const { return numbersBelow<TriangleNumber>(count()); }
    [[nodiscard]] std::span<const Vertex, 3> corners(TriangleNumber t) const {
        return std::span<const Vertex, 3>(indices.data() + 3 * indexOf(t), 3);
    }
};

// The primitive of each triangle.
template <typename Vertex>
Numbered<TriangleNumber, PrimitiveNumber> primitivesOf(const TriangleSet<Vertex>& triangles) {
    Numbered<TriangleNumber, PrimitiveNumber> primitives;
    primitives.reserve(triangles.count());
    for (const PrimitiveNumber p : triangles.primitiveIndexCounts.numbers())
        primitives.insert(primitives.end(), triangles.primitiveIndexCounts[p] / 3, p);
    return primitives;
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

// The corners without their type.
template <typename Vertex>
std::vector<std::uint32_t> plainCorners(const TriangleSet<Vertex>& triangles) {
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.indices.size());
    for (const Vertex v : triangles.indices) corners.push_back(v.value);
    return corners;
}

}  // namespace defocus::engine
