#pragma once
// Solves damped linear systems with a few dozen unknowns.

#include <span>
#include <vector>

namespace defocus::engine {

// Solves (M + damping·d·I) x = b by Cholesky decomposition, where d is the mean of M's diagonal, and returns x. M is
// symmetric positive semi-definite and stored as n × n values in row-major order. Only the lower triangle is read.
// damping > 0. Returns zeros if M is zero.
std::vector<double> dampedSolution(std::span<const double> matrix, std::span<const double> b, double damping);

}  // namespace defocus::engine
