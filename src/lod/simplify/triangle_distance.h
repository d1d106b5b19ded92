#pragma once
// Ericson 2005, Real-Time Collision Detection, 5.1.5: the point of a triangle that is closest to another point, by
// Voronoi region.

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace defocus {

// (u, v) of the closest point a + u·(b − a) + v·(c − a) of the triangle abc to `p`.
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

    // Twice the areas that p spans with each edge, times the triangle's: ≤ 0 beyond the edge.
    const double overAb = alongAbFromA * alongAcFromB - alongAbFromB * alongAcFromA;
    if (overAb <= 0 && alongAbFromA >= 0 && alongAbFromB <= 0) return {alongAbFromA / (alongAbFromA - alongAbFromB), 0};
    const double overAc = alongAbFromC * alongAcFromA - alongAbFromA * alongAcFromC;
    if (overAc <= 0 && alongAcFromA >= 0 && alongAcFromC <= 0) return {0, alongAcFromA / (alongAcFromA - alongAcFromC)};
    const double overBc = alongAbFromB * alongAcFromC - alongAbFromC * alongAcFromB;
    const double pastB = alongAcFromB - alongAbFromB;
    const double pastC = alongAbFromC - alongAcFromC;
    if (overBc <= 0 && pastB >= 0 && pastC >= 0) return {pastC / (pastB + pastC), pastB / (pastB + pastC)};
    const double whole = overAb + overAc + overBc;
    return {overAc / whole, overAb / whole};
}

inline glm::dvec3 closestPoint(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec2 along = closestCoordinates(p, a, b, c);
    return a + along.x * (b - a) + along.y * (c - a);
}

}  // namespace defocus
