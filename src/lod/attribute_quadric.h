#pragma once
// Hoppe 1999, New Quadric Metric for Simplifying Meshes with Appearance Attributes: how far attributes at a place are
// from what faces interpolate linearly there, squared and weighed by their areas.

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus {

constexpr std::size_t attributeCount = 8;  // normal, colour, uv
using AttributeRow = std::array<float, attributeCount>;

struct AttributeQuadric {
    // Of Σ w·(g·p + d − s)² over faces and attributes: Σ w·g·gᵀ, Σ w·d·g, Σ w·d², Σ w; then Σ w·g and Σ w·d of each.
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    glm::dvec3 b{0};
    double c = 0;
    double weight = 0;
    std::array<glm::dvec3, attributeCount> gradient{};
    std::array<double, attributeCount> offset{};

    // A face with the corners `p` (not on one line) and their attributes.
    void addFace(const glm::dvec3* const* p, const AttributeRow* const* s, double faceWeight) {
        const glm::dvec3 e1 = *p[1] - *p[0];
        const glm::dvec3 e2 = *p[2] - *p[0];
        const glm::dvec3 normal = glm::cross(e1, e2);
        const double square = glm::dot(normal, normal);
        const glm::dvec3 along1 = glm::cross(e2, normal) / square;
        const glm::dvec3 along2 = glm::cross(normal, e1) / square;
        weight += faceWeight;
        for (std::size_t j = 0; j < attributeCount; ++j) {
            const double s0 = (*s[0])[j];
            const glm::dvec3 g = ((*s[1])[j] - s0) * along1 + ((*s[2])[j] - s0) * along2;
            const double d = s0 - glm::dot(g, *p[0]);
            const glm::dvec3 weighted = faceWeight * g;
            xx += weighted.x * g.x;
            xy += weighted.x * g.y;
            xz += weighted.x * g.z;
            yy += weighted.y * g.y;
            yz += weighted.y * g.z;
            zz += weighted.z * g.z;
            b += d * weighted;
            c += faceWeight * d * d;
            gradient[j] += weighted;
            offset[j] += faceWeight * d;
        }
    }

    void add(const AttributeQuadric& other) {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        b += other.b;
        c += other.c;
        weight += other.weight;
        for (std::size_t j = 0; j < attributeCount; ++j) {
            gradient[j] += other.gradient[j];
            offset[j] += other.offset[j];
        }
    }

    [[nodiscard]] double at(const glm::dvec3& p, const AttributeRow& s) const {
        double sum = p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z)) + p.y * (yy * p.y + 2 * yz * p.z) + zz * p.z * p.z +
                     2 * glm::dot(b, p) + c;
        for (std::size_t j = 0; j < attributeCount; ++j)
            sum += s[j] * (weight * s[j] - 2 * (glm::dot(gradient[j], p) + offset[j]));
        return std::max(0.0, sum);
    }
};

}  // namespace defocus
