#pragma once
// Fits values at triangle corners by least squares to targets at points on the triangles. Minimises
//   Σ share·|Σ b·x − target|² + pull·Σ weight·|x − prior|²
// over the corner values x. The first sum is over the target points: share is the weight of a point, and b are its
// barycentric coordinates in its triangle. The last sum is over the corners: weight is the sum of share·b at a corner,
// prior is the corner's initial value, and pull is a small constant that prevents overshoot.
// The solver is the conjugate gradient method with a Jacobi preconditioner (Hestenes and Stiefel 1952). The normal
// equations are stored as one 3 × 3 matrix per triangle. The time of an iteration is therefore independent of the
// number of points. Eigen's ConjugateGradient takes five times as long; building the pyramids (levels of detail) of the
// school of fish, a built-in scene, would take 4 % longer.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/simplify/number.h"

namespace defocus::engine {

using UnknownNumber = Number<struct UnknownKind>;

// Sums of share·bᵢ·bⱼ over the target points of one triangle, for (i, j) = 00, 11, 22, 01, 12, 20. share is the weight
// of a point, and bᵢ its barycentric coordinate for corner i.
using TriangleSums = std::array<float, 6>;

struct LeastSquares {
    // Up to four channels per corner, processed as one SIMD vector; unused channels are 0.
    using Row = float __attribute__((vector_size(16)));
    using Rows = Numbered<UnknownNumber, Row>;
    static constexpr std::size_t channels = 4;

    std::span<const TriangleSums> triangles;
    Numbered<TriangleCorner, UnknownNumber> corners;
    // Total weight of each unknown's target points. An unknown with weight 0 keeps its initial value.
    Numbered<UnknownNumber, float> weights;
    Rows sums;                                   // weighted sum of each unknown's target values
    Rows solution;                               // input: initial value and prior; output: solution
    Numbered<UnknownNumber, std::uint8_t> held;  // 1: the unknown keeps its initial value; empty: all are free

    static constexpr int iterations = 4;  // number of iterations; more cause no visible change
    // Strength of the pull towards the prior (the initial value), relative to an unknown's weight. It keeps unknowns
    // with few target points from overshooting.
    static constexpr float pull = 0.01f;

    // Solves the normal equations and stores the result in `solution`; overwrites `sums`.
    void solve() {
        inverseDiagonal_.resize(weights.size());
        for (const UnknownNumber g : weights.numbers()) inverseDiagonal_[g] = pull * weights[g];
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) inverseDiagonal_[cornersOf(t)[k]] += triangles[t][k];
        for (float& d : inverseDiagonal_) d = d > 0 ? 1 / d : 0;
        for (const UnknownNumber g : held.numbers())
            if (held[g] != 0) inverseDiagonal_[g] = 0;
        Rows image(weights.size());
        apply(solution, image);
        Rows& residual = sums;
        for (const UnknownNumber g : weights.numbers()) residual[g] += pull * weights[g] * solution[g] - image[g];

        Rows direction(weights.size());
        for (const UnknownNumber g : weights.numbers()) direction[g] = inverseDiagonal_[g] * residual[g];
        Row energy = dot(residual, direction);
        for (int iteration = 0; iteration < iterations; ++iteration) {
            apply(direction, image);
            const Row curvature = dot(direction, image);
            Row step{};
            for (std::size_t c = 0; c < channels; ++c) step[c] = curvature[c] > 0 ? energy[c] / curvature[c] : 0;
            for (const UnknownNumber g : weights.numbers()) {
                solution[g] += step * direction[g];
                residual[g] -= step * image[g];
            }
            Rows& next = image;
            for (const UnknownNumber g : weights.numbers()) next[g] = inverseDiagonal_[g] * residual[g];
            const Row nextEnergy = dot(residual, next);
            Row turn{};
            for (std::size_t c = 0; c < channels; ++c) turn[c] = energy[c] > 0 ? nextEnergy[c] / energy[c] : 0;
            for (const UnknownNumber g : weights.numbers()) direction[g] = next[g] + turn * direction[g];
            energy = nextEnergy;
        }
    }

private:
    [[nodiscard]] const UnknownNumber* cornersOf(std::size_t triangle) const { return &corners.data()[3 * triangle]; }

    // Multiplies the matrix of the normal equations by `x`.
    void apply(const Rows& x, Rows& result) const {
        for (const UnknownNumber g : x.numbers()) result[g] = pull * weights[g] * x[g];
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const TriangleSums& m = triangles[t];
            const UnknownNumber* g = cornersOf(t);
            const Row a = x[g[0]];
            const Row b = x[g[1]];
            const Row d = x[g[2]];
            result[g[0]] += m[0] * a + m[3] * b + m[5] * d;
            result[g[1]] += m[3] * a + m[1] * b + m[4] * d;
            result[g[2]] += m[5] * a + m[4] * b + m[2] * d;
        }
    }

    static Row dot(const Rows& a, const Rows& b) {
        std::array<double, channels> sums{};
        for (const UnknownNumber g : a.numbers())
            for (std::size_t c = 0; c < channels; ++c) sums[c] += double{a[g][c]} * double{b[g][c]};
        Row result{};
        for (std::size_t c = 0; c < channels; ++c) result[c] = static_cast<float>(sums[c]);
        return result;
    }

    // reciprocal diagonal of the matrix; 0 for unknowns that keep their initial value
    Numbered<UnknownNumber, float> inverseDiagonal_;
};

}  // namespace defocus::engine
