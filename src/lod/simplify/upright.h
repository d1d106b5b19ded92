#pragma once
// Guards what is fitted against triangles that turn over.

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus {

// Moves corners back to where they were until no triangle is turned by more than 60°; at worst all of them.
// cornersOf(t) are the three items of both arrays, below `triangles`, that a triangle joins.
template <typename Points, typename CornersOf>
void keepFacesUpright(Points& fitted, const Points& original, std::size_t triangles, const CornersOf& cornersOf) {
    constexpr double leastTurnCosine = 0.5;
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
            if (glm::dot(before, after) >= leastTurnCosine * glm::length(before) * glm::length(after)) continue;
            for (const auto corner : corners) {
                changed |= fitted[corner] != original[corner];
                fitted[corner] = original[corner];
            }
        }
    }
}

}  // namespace defocus
