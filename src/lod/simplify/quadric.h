#pragma once
// Defines quadrics, which measure the error of a collapse.
//
// A position quadric is the weighted sum of squared distances to a set of planes, dᵀAd + 2bᵀd + c (Garland and Heckbert
// 1997, Surface Simplification Using Quadric Error Metrics). d is the offset from the vertex that owns the quadric.
// Quadrics are evaluated only near their vertex, so that single precision suffices.
//
// An attribute quadric is the squared difference between the attributes of a vertex and the linear interpolation of the
// faces' attributes at the same position, weighted by face area (Hoppe 1999, New Quadric Metric for Simplifying Meshes
// with Appearance Attributes). Attributes are relative to the attributes of the vertex that owns the quadric. The
// number of attributes `n` is a template parameter, so that memory is used only for attributes that the mesh has.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace defocus::engine {

struct Quadric {
    float c = 0;       // value of the quadric at the vertex itself
    float weight = 0;  // total weight of the planes
    glm::vec3 b{0};
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // elements of the symmetric matrix A

    // Adds a plane through the vertex with the unit normal `normal`.
    void addPlane(const glm::vec3& normal, float planeWeight) {
        addSquare(normal, planeWeight);
        weight += planeWeight;
    }

    // Adds squareWeight · (gᵀd)² to the quadric, where d is the offset from the vertex; `weight` is unchanged.
    void addSquare(const glm::vec3& g, float squareWeight) {
        const glm::vec3 weighted = squareWeight * g;
        xx += weighted.x * g.x;
        xy += weighted.x * g.y;
        xz += weighted.x * g.z;
        yy += weighted.y * g.y;
        yz += weighted.y * g.z;
        zz += weighted.z * g.z;
    }

    // Adds the quadric of another vertex. `step` is the vector from the other vertex to this one.
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

    // Returns the weighted sum of squared distances at offset d; never negative.
    [[nodiscard]] float at(const glm::vec3& d) const { return std::max(0.0f, glm::dot(timesA(d) + 2.0f * b, d) + c); }
};

template <std::size_t n>
using AttributeRow = std::array<float, n>;

// Gradient of each attribute over a face, per unit of length along each axis.
template <std::size_t n>
struct AttributeGradients {
    AttributeRow<n> x, y, z;

    [[nodiscard]] glm::vec3 of(std::size_t attribute) const { return {x[attribute], y[attribute], z[attribute]}; }
};

// Returns the gradients of the attributes over a face. `p` are the positions of its corners (not collinear), `s` the
// attributes at the corners.
template <std::size_t n>
AttributeGradients<n> attributeGradients(const glm::dvec3* const* p, const AttributeRow<n>* const* s) {
    const glm::dvec3 e1 = *p[1] - *p[0];
    const glm::dvec3 e2 = *p[2] - *p[0];
    const glm::dvec3 normal = glm::cross(e1, e2);
    const double square = glm::dot(normal, normal);
    const glm::vec3 along1(glm::cross(e2, normal) / square);
    const glm::vec3 along2(glm::cross(normal, e1) / square);
    AttributeGradients<n> gradients;
    for (std::size_t j = 0; j < n; ++j) {
        const float d1 = (*s[1])[j] - (*s[0])[j];
        const float d2 = (*s[2])[j] - (*s[0])[j];
        gradients.x[j] = d1 * along1.x + d2 * along2.x;
        gradients.y[j] = d1 * along1.y + d2 * along2.y;
        gradients.z[j] = d1 * along1.z + d2 * along2.z;
    }
    return gradients;
}

template <std::size_t n>
struct AttributeQuadric {
    // Σ w·(g·d + e − s)² over faces and attributes, where d and s are the offsets of the position and the attribute
    // from the vertex. w is the face's weight, g the attribute's gradient over the face, and e the face's value at the
    // vertex minus the vertex's own value. `squares` holds the terms without s, and squares.weight is Σ w. Per
    // attribute, `gradients` holds Σ w·g, and `offset` Σ w·e.
    Quadric squares;
    AttributeGradients<n> gradients{};
    AttributeRow<n> offset{};

    // Adds a face at the vertex. The face's corner must have the vertex's own attributes: e is then 0, and `offset`
    // (the sum of w·e) is unchanged.
    void addFace(const AttributeGradients<n>& face, float faceWeight) {
        squares.weight += faceWeight;
        for (std::size_t j = 0; j < n; ++j) {
            squares.addSquare(face.of(j), faceWeight);
            gradients.x[j] += faceWeight * face.x[j];
            gradients.y[j] += faceWeight * face.y[j];
            gradients.z[j] += faceWeight * face.z[j];
        }
    }

    // Adds another quadric of the same vertex. This function does not add offsets, so `other` must be made by addFace()
    // alone, which leaves its offset zero.
    void addFaces(const AttributeQuadric& other) {
        squares.add(other.squares, glm::vec3(0));
        for (std::size_t j = 0; j < n; ++j) {
            gradients.x[j] += other.gradients.x[j];
            gradients.y[j] += other.gradients.y[j];
            gradients.z[j] += other.gradients.z[j];
        }
    }

    // Adds the quadric of another vertex. `step` and `change` are the differences in position and attributes from the
    // other vertex to this one.
    void add(const AttributeQuadric& other, const glm::vec3& step, const AttributeRow<n>& change) {
        const float cost = other.at(step, change);
        const AttributeGradients<n>& g = other.gradients;
        glm::vec3 turned(0);
        for (std::size_t j = 0; j < n; ++j) {
            turned += change[j] * g.of(j);
            offset[j] += other.offset[j] + g.x[j] * step.x + g.y[j] * step.y + g.z[j] * step.z -
                         other.squares.weight * change[j];
            gradients.x[j] += g.x[j];
            gradients.y[j] += g.y[j];
            gradients.z[j] += g.z[j];
        }
        const float c = squares.c;
        squares.add(other.squares, step);
        squares.b -= turned;
        squares.c = c + cost;
    }

    // Returns the quadric's value at the position offset `step` and the attribute offset `change`; never negative.
    [[nodiscard]] float at(const glm::vec3& step, const AttributeRow<n>& change) const {
        AttributeRow<std::bit_ceil(n)> terms{};
        for (std::size_t j = 0; j < n; ++j) {
            const float mean = gradients.x[j] * step.x + gradients.y[j] * step.y + gradients.z[j] * step.z + offset[j];
            terms[j] = change[j] * (squares.weight * change[j] - 2 * mean);
        }
        for (std::size_t width = terms.size() / 2; width > 0; width /= 2)
            for (std::size_t j = 0; j < width; ++j) terms[j] += terms[j + width];
        return std::max(0.0f, squares.at(step) + terms[0]);
    }
};

}  // namespace defocus::engine
