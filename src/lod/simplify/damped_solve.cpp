#include "lod/simplify/damped_solve.h"

#include <Eigen/Cholesky>

namespace defocus::engine {

std::vector<double> dampedSolution(std::span<const double> matrix, std::span<const double> b, double damping) {
    const auto n = static_cast<Eigen::Index>(b.size());
    std::vector<double> x(b.begin(), b.end());
    Eigen::Map<Eigen::VectorXd> solution(x.data(), n);
    // The lower triangle in row-major order is the upper triangle in Eigen's column-major order.
    Eigen::MatrixXd damped = Eigen::Map<const Eigen::MatrixXd>(matrix.data(), n, n);
    const double trace = damped.trace();
    damped.diagonal().array() += damping * trace / static_cast<double>(n);
    if (trace > 0)
        damped.selfadjointView<Eigen::Upper>().llt().solveInPlace(solution);
    else
        solution.setZero();
    return x;
}

}  // namespace defocus::engine
