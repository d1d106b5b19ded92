#pragma once
// Converts plain lists to arrays that are indexed by the simplifier's index types.

#include <cstdint>
#include <vector>

#include "lod/simplify/triangle_set.h"

namespace defocus::engine {

template <typename Numbers>
Numbers numbered(const std::vector<std::uint32_t>& values) {
    Numbers result;
    for (const std::uint32_t value : values) result.push_back({value});
    return result;
}

template <typename Vertex>
TriangleSet<Vertex> numberedTriangles(const std::vector<std::vector<std::uint32_t>>& primitives) {
    TriangleSet<Vertex> triangles;
    for (const auto& indices : primitives) {
        for (const std::uint32_t v : indices) triangles.indices.push_back({v});
        triangles.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(indices.size()));
    }
    return triangles;
}

}  // namespace defocus::engine
