#pragma once
// Damped linear equations of a few dozen unknowns.

#include <span>
#include <vector>

namespace defocus::engine {

// Returns x of (M + damping·d·I) x = b by Cholesky's decomposition, where d is the mean of M's diagonal. M is symmetric
// and positive semi-definite, and damping > 0. Of M's n × n values, row by row, those on and below the diagonal are
// read. Returns zeros where M is zero.
std::vector<double> dampedSolution(std::span<const double> matrix, std::span<const double> b, double damping);

}  // namespace defocus::engine
