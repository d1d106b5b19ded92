#pragma once
// Values at the corners of triangles, fitted to targets at points of them: minimises
//   Σ share·|Σ weight·x − target|² + pull·Σ weightOf·|x − prior|²
// by conjugate gradients with Jacobi's preconditioner (Hestenes and Stiefel 1952). The normal equations are kept as one
// matrix a triangle, so that an iteration costs what the triangles do, however many points there are.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace defocus {

// Σ share·weightᵢ·weightⱼ over the points of one triangle, for (i, j) = 00, 11, 22, 01, 12, 20.
using TriangleSums = std::array<double, 6>;

template <std::size_t channels>
struct LeastSquares {
    using Row = std::array<float, channels>;
    using Rows = std::vector<Row>;

    std::span<const TriangleSums> triangles;
    std::vector<std::uint32_t> corners;  // the unknown at each corner, three a triangle
    // Of each unknown:
    std::vector<float> weights;  // Σ share·weight; 0: it keeps its start
    Rows sums;                   // Σ share·weight·target
    Rows solution;               // start, and prior; then the solution

    static constexpr int iterations = 4;  // more change nothing that can be seen
    // Pull towards the prior, as a share of an unknown's weight: keeps those with few points from overshooting.
    static constexpr float pull = 0.01f;

    void solve() {
        diagonal_.resize(weights.size());
        for (std::size_t g = 0; g < weights.size(); ++g) diagonal_[g] = pull * weights[g];
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) diagonal_[corners[3 * t + k]] += static_cast<float>(triangles[t][k]);
        residual_.resize(weights.size());
        apply(solution, residual_);
        for (std::size_t g = 0; g < weights.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c)
                residual_[g][c] = sums[g][c] + pull * weights[g] * solution[g][c] - residual_[g][c];

        Rows next = preconditioned();
        Rows direction = next;
        Rows image(weights.size());
        Row energy = dot(residual_, direction);
        for (int iteration = 0; iteration < iterations; ++iteration) {
            apply(direction, image);
            const Row curvature = dot(direction, image);
            Row step{};
            for (std::size_t c = 0; c < channels; ++c) step[c] = curvature[c] > 0 ? energy[c] / curvature[c] : 0;
            for (std::size_t g = 0; g < weights.size(); ++g)
                for (std::size_t c = 0; c < channels; ++c) {
                    solution[g][c] += step[c] * direction[g][c];
                    residual_[g][c] -= step[c] * image[g][c];
                }
            next = preconditioned();
            const Row nextEnergy = dot(residual_, next);
            for (std::size_t g = 0; g < weights.size(); ++g)
                for (std::size_t c = 0; c < channels; ++c)
                    direction[g][c] = next[g][c] + (energy[c] > 0 ? nextEnergy[c] / energy[c] : 0) * direction[g][c];
            energy = nextEnergy;
        }
    }

private:
    // The normal equations' matrix times `x`.
    void apply(const Rows& x, Rows& result) const {
        for (std::size_t g = 0; g < x.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c) result[g][c] = pull * weights[g] * x[g][c];
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            std::array<float, 6> m;
            std::copy(triangles[t].begin(), triangles[t].end(), m.begin());
            const std::uint32_t* g = &corners[3 * t];
            const Row a = x[g[0]];
            const Row b = x[g[1]];
            const Row d = x[g[2]];
            for (std::size_t c = 0; c < channels; ++c) {
                result[g[0]][c] += m[0] * a[c] + m[3] * b[c] + m[5] * d[c];
                result[g[1]][c] += m[3] * a[c] + m[1] * b[c] + m[4] * d[c];
                result[g[2]][c] += m[5] * a[c] + m[4] * b[c] + m[2] * d[c];
            }
        }
    }

    Rows preconditioned() const {
        Rows result(residual_.size());
        for (std::size_t g = 0; g < result.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c)
                result[g][c] = diagonal_[g] > 0 ? residual_[g][c] / diagonal_[g] : 0;
        return result;
    }

    static Row dot(const Rows& a, const Rows& b) {
        std::array<double, channels> sums{};
        for (std::size_t g = 0; g < a.size(); ++g)
            for (std::size_t c = 0; c < channels; ++c) sums[c] += double{a[g][c]} * double{b[g][c]};
        Row result;
        std::copy(sums.begin(), sums.end(), result.begin());
        return result;
    }

    std::vector<float> diagonal_;
    Rows residual_;
};

}  // namespace defocus
