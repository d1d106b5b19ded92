#pragma once
// Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics: the weighted sum of squared distances
// to a set of planes, pᵀAp + 2bᵀp + c.

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus {

struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A
    glm::dvec3 b{0};
    double c = 0;
    double weight = 0;  // of all planes together

    // The plane through `point` with the unit normal `normal`.
    void addPlane(const glm::dvec3& normal, const glm::dvec3& point, double planeWeight) {
        addSquare(normal, -glm::dot(normal, point), planeWeight);
        weight += planeWeight;
    }

    // squareWeight · (gᵀp + offset)², without counting towards `weight`.
    void addSquare(const glm::dvec3& g, double offset, double squareWeight) {
        const glm::dvec3 weighted = squareWeight * g;
        xx += weighted.x * g.x;
        xy += weighted.x * g.y;
        xz += weighted.x * g.z;
        yy += weighted.y * g.y;
        yz += weighted.y * g.z;
        zz += weighted.z * g.z;
        b += weighted * offset;
        c += squareWeight * offset * offset;
    }

    void add(const Quadric& other) {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        b += other.b;
        c += other.c;
        weight += other.weight;
    }

    [[nodiscard]] double at(const glm::dvec3& p) const {
        const double quadratic =
            p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z)) + p.y * (yy * p.y + 2 * yz * p.z) + zz * p.z * p.z;
        return std::max(0.0, quadratic + 2 * glm::dot(b, p) + c);
    }
};

}  // namespace defocus
