#pragma once
// Solves a few linear equations with a symmetric matrix, by Cholesky's decomposition. Eigen would be a dependency for
// these lines alone.

#include <cmath>
#include <cstddef>
#include <vector>

namespace defocus {

// Solves (M + slack·d) x = b, d the mean of M's diagonal; of the n × n values of `matrix`, row by row, those on and
// below the diagonal are read. M is positive semi-definite, slack > 0. Zero where M is.
inline std::vector<double> solvedSymmetric(std::vector<double> matrix, std::vector<double> b, double slack) {
    const std::size_t n = b.size();
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += matrix[i * n + i];
    if (!(trace > 0)) return std::vector<double>(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        matrix[i * n + i] += slack * trace / static_cast<double>(n);
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = matrix[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= matrix[i * n + k] * matrix[j * n + k];
            matrix[i * n + j] = i == j ? std::sqrt(sum) : sum / matrix[j * n + j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= matrix[i * n + k] * b[k];
        b[i] /= matrix[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= matrix[k * n + i] * b[k];
        b[i] /= matrix[i * n + i];
    }
    return b;
}

}  // namespace defocus
