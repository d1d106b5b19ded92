#pragma once
// Computes areas, closest points and integration points of single triangles, and moves fitted vertices back if
// triangles would flip.

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>
#include <utility>

namespace defocus::engine {

// Returns a triangle's normal, whose length is twice the triangle's area. at(corner) is the corner's position.
template <typename Corner, typename At>
glm::dvec3 triangleCross(std::span<const Corner, 3> corners, const At& at) {
    const glm::dvec3 a = at(corners[0]);
    return glm::cross(glm::dvec3(at(corners[1])) - a, glm::dvec3(at(corners[2])) - a);
}

// Returns (u, v) of the point a + u·(b − a) + v·(c − a) of triangle abc that is closest to `p`. The method tests the
// triangle's Voronoi regions (Ericson 2005, Real-Time Collision Detection, 5.1.5).
inline glm::dvec2 closestCoordinates(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const double alongAbFromA = glm::dot(ab, p - a);
    const double alongAcFromA = glm::dot(ac, p - a);
    if (alongAbFromA <= 0 && alongAcFromA <= 0) return {0, 0};
    const double alongAbFromB = glm::dot(ab, p - b);
    const double alongAcFromB = glm::dot(ac, p - b);
    if (alongAbFromB >= 0 && alongAcFromB <= alongAbFromB) return {1, 0};
    const double alongAbFromC = glm::dot(ab, p - c);
    const double alongAcFromC = glm::dot(ac, p - c);
    if (alongAcFromC >= 0 && alongAbFromC <= alongAcFromC) return {0, 1};

    // overAb = 4 · area(abc) · signed area(abp). If this product is ≤ 0, p lies beyond edge ab.
    const double overAb = alongAbFromA * alongAcFromB - alongAbFromB * alongAcFromA;
    if (overAb <= 0 && alongAbFromA >= 0 && alongAbFromB <= 0) return {alongAbFromA / (alongAbFromA - alongAbFromB), 0};
    const double overAc = alongAbFromC * alongAcFromA - alongAbFromA * alongAcFromC;
    if (overAc <= 0 && alongAcFromA >= 0 && alongAcFromC <= 0) return {0, alongAcFromA / (alongAcFromA - alongAcFromC)};
    const double overBc = alongAbFromB * alongAcFromC - alongAbFromC * alongAcFromB;
    const double pastB = alongAcFromB - alongAbFromB;
    const double pastC = alongAbFromC - alongAcFromC;
    if (overBc <= 0 && pastB >= 0 && pastC >= 0) return {pastC / (pastB + pastC), pastB / (pastB + pastC)};
    const double total = overAb + overAc + overBc;
    return {overAc / total, overAb / total};
}

inline glm::dvec3 closestPoint(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec2 along = closestCoordinates(p, a, b, c);
    return a + along.x * (b - a) + along.y * (c - a);
}

// Calls visit(weights, share) for the integration points of a triangle. The triangle is divided into parts² congruent
// triangles with three points each, which integrate quadratic functions exactly (Strang and Fix 1973). No point lies on
// an edge, because the normals on both sides of a sharp rim may cancel there. `weights` are the barycentric coordinates
// of a point; `share` is its fraction of the area, and all shares sum to 1.
template <typename Visit>
void forEachTrianglePoint(int parts, const Visit& visit) {
    const double step = 1.0 / parts;
    const auto points = [&](double x, double y, double size) {
        for (const auto& [dx, dy] : {std::pair{1.0, 1.0}, std::pair{4.0, 1.0}, std::pair{1.0, 4.0}}) {
            const double s = x + dx * size / 6;
            const double t = y + dy * size / 6;
            visit(glm::dvec3(1 - s - t, s, t), step * step / 3);
        }
    };
    for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j) {
            points(i * step, j * step, step);
            if (i + j + 1 < parts) points((i + 1) * step, (j + 1) * step, -step);
        }
}

// Moves fitted corners back to their original positions until no triangle is rotated by more than 60°. In the worst
// case, all corners move back. cornersOf(t), for t below `triangles`, returns the indices of triangle t's corners in
// `fitted` and `original`.
template <typename Points, typename CornersOf>
void keepFacesUpright(Points& fitted, const Points& original, std::size_t triangles, const CornersOf& cornersOf) {
    constexpr double minTurnCosine = 0.5;
    const auto normalOf = [&](const Points& points, const auto& corners) {
        const glm::dvec3 a = points[corners[0]];
        return glm::cross(glm::dvec3(points[corners[1]]) - a, glm::dvec3(points[corners[2]]) - a);
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t t = 0; t < triangles; ++t) {
            const auto corners = cornersOf(t);
            const glm::dvec3 before = normalOf(original, corners);
            const glm::dvec3 after = normalOf(fitted, corners);
            if (glm::dot(before, after) >= minTurnCosine * glm::length(before) * glm::length(after)) continue;
            for (const auto corner : corners) {
                changed |= fitted[corner] != original[corner];
                fitted[corner] = original[corner];
            }
        }
    }
}

}  // namespace defocus::engine
