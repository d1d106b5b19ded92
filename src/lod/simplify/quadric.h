#pragma once
// Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics: the weighted sum of squared distances
// to a set of planes, dᵀAd + 2bᵀd + c.
//
// Places d are steps from the vertex that the quadric belongs to. All places that it is asked for lie near by, so that
// single precision serves.

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus {

struct Quadric {
    float c = 0;       // the sum at the vertex itself
    float weight = 0;  // of all planes together
    glm::vec3 b{0};
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A

    // Adds the plane through the vertex with the unit normal `normal`.
    void addPlane(const glm::vec3& normal, float planeWeight) {
        addSquare(normal, planeWeight);
        weight += planeWeight;
    }

    // Adds squareWeight · (gᵀd)², which doesn't count towards `weight`.
    void addSquare(const glm::vec3& g, float squareWeight) {
        const glm::vec3 weighted = squareWeight * g;
        xx += weighted.x * g.x;
        xy += weighted.x * g.y;
        xz += weighted.x * g.z;
        yy += weighted.y * g.y;
        yz += weighted.y * g.z;
        zz += weighted.z * g.z;
    }

    // Adds the quadric of another vertex, from which `step` leads to this one's.
    void add(const Quadric& other, const glm::vec3& step) {
        b += other.b + other.timesA(step);
        c += other.at(step);
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        weight += other.weight;
    }

    [[nodiscard]] glm::vec3 timesA(const glm::vec3& d) const {
        return {xx * d.x + xy * d.y + xz * d.z, xy * d.x + yy * d.y + yz * d.z, xz * d.x + yz * d.y + zz * d.z};
    }

    // The sum at d; never negative.
    [[nodiscard]] float at(const glm::vec3& d) const { return std::max(0.0f, glm::dot(timesA(d) + 2.0f * b, d) + c); }
};

}  // namespace defocus
