#include "plan/visible/lens_facing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace defocus::engine {

namespace {

// Returns (Nx, Ny, det), as defined in lens_facing.h, in polar form (blossom): a trilinear function of three triangles.
// Means of its values for the first and the last triangle of the motion are the Bernstein coefficients over time.
glm::dvec3 blossom(const LensTriangle& a, const LensTriangle& b, const LensTriangle& c) {
    glm::dvec3 result(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const glm::dvec3 cross = glm::cross(b.places[j], c.places[k]);
        result.x += a.coc[i] * cross.x;
        result.y += a.coc[i] * cross.y;
    }
    result.z = glm::dot(a.places[0], glm::cross(b.places[1], c.places[2]));
    return result;
}

double overLens(const glm::dvec3& coefficients, double aspect, double radius) {
    return coefficients.z + radius * std::hypot(coefficients.x, aspect * coefficients.y);
}

}  // namespace

double largestDeterminant(const LensTriangle& triangle, double aspect, double radius) {
    return overLens(blossom(triangle, triangle, triangle), aspect, radius);
}

double largestDeterminant(const LensTriangle& from, const LensTriangle& to, double aspect, double radius) {
    const glm::dvec3 coefficients[4] = {
        blossom(from, from, from),
        (blossom(to, from, from) + blossom(from, to, from) + blossom(from, from, to)) / 3.0,
        (blossom(from, to, to) + blossom(to, from, to) + blossom(to, to, from)) / 3.0,
        blossom(to, to, to),
    };
    double largest = overLens(coefficients[0], aspect, radius);
    for (const glm::dvec3& each : coefficients) largest = std::max(largest, overLens(each, aspect, radius));
    return largest;
}

LensTriangle between(const LensTriangle& from, const LensTriangle& to, double share) {
    LensTriangle result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.places[i] = (1 - share) * from.places[i] + share * to.places[i];
        result.coc[i] = (1 - share) * from.coc[i] + share * to.coc[i];
    }
    return result;
}

}  // namespace defocus::engine
