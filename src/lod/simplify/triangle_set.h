#pragma once
// Triangles in the form that all of `lod` passes on: primitive after primitive, three corners each.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace defocus {

struct TriangleSet {
    std::vector<std::uint32_t> indices;               // three a triangle; whose numbers these are, the owner says
    std::vector<std::uint32_t> primitiveIndexCounts;  // three for each triangle of a primitive

    [[nodiscard]] std::size_t count() const { return indices.size() / 3; }
};

// The number of each triangle's primitive.
inline std::vector<std::uint32_t> primitivesOf(const TriangleSet& triangles) {
    std::vector<std::uint32_t> primitives;
    primitives.reserve(triangles.count());
    for (std::uint32_t p = 0; p < triangles.primitiveIndexCounts.size(); ++p)
        primitives.insert(primitives.end(), triangles.primitiveIndexCounts[p] / 3, p);
    return primitives;
}

// Corner 3·t + i is corner i of triangle t; the one after it and the one before it in the same triangle.
constexpr std::uint32_t nextCorner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
constexpr std::uint32_t previousCorner(std::uint32_t corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

}  // namespace defocus
