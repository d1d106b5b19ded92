#pragma once
// Hoppe 1999, New Quadric Metric for Simplifying Meshes with Appearance Attributes: how far attributes at a place are
// from what faces interpolate linearly there, squared and weighed by their areas.

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lod/quadric.h"

namespace defocus {

constexpr std::size_t attributeCount = 8;  // normal, colour, uv
using AttributeRow = std::array<float, attributeCount>;

struct AttributeQuadric {
    // Of Σ w·(g·p + d − s)² over faces and attributes: the part without s (its weight is Σ w); then Σ w·g and Σ w·d of
    // each attribute.
    Quadric squares;
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
        squares.weight += faceWeight;
        for (std::size_t j = 0; j < attributeCount; ++j) {
            const double s0 = (*s[0])[j];
            const glm::dvec3 g = ((*s[1])[j] - s0) * along1 + ((*s[2])[j] - s0) * along2;
            const double d = s0 - glm::dot(g, *p[0]);
            squares.addSquare(g, d, faceWeight);
            gradient[j] += faceWeight * g;
            offset[j] += faceWeight * d;
        }
    }

    void add(const AttributeQuadric& other) {
        squares.add(other.squares);
        for (std::size_t j = 0; j < attributeCount; ++j) {
            gradient[j] += other.gradient[j];
            offset[j] += other.offset[j];
        }
    }

    [[nodiscard]] double at(const glm::dvec3& p, const AttributeRow& s) const {
        double sum = squares.at(p);
        for (std::size_t j = 0; j < attributeCount; ++j)
            sum += s[j] * (squares.weight * s[j] - 2 * (glm::dot(gradient[j], p) + offset[j]));
        return std::max(0.0, sum);
    }
};

}  // namespace defocus
