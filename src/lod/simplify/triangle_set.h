#pragma once
// Triangles in the form that all of `lod` passes on: primitive after primitive, three corners each.

#include <cstddef>
#include <cstdint>
#include <span>

#include "lod/simplify/number.h"

namespace defocus {

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

}  // namespace defocus
