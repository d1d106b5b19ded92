#pragma once
// Areas of triangles, and means over them. Corners are numbers of any kind; functions say where they lie.

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "lod/simplify/triangle_set.h"

namespace defocus {

// Twice the area of a triangle, along its normal; at(corner) is its place.
template <typename Corner, typename At>
glm::dvec3 triangleCross(std::span<const Corner, 3> corners, const At& at) {
    const glm::dvec3 a = at(corners[0]);
    return glm::cross(glm::dvec3(at(corners[1])) - a, glm::dvec3(at(corners[2])) - a);
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

}  // namespace defocus
