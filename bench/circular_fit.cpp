// Fits the separable complex kernels of src/render/circular/circular_kernel.h to a disk, by least squares over the
// square that the taps cover. Prints the kernels in the format of the table in circular_kernel.cpp, and compares them
// with the published kernels.
//
// Variable projection (Golub and Pereyra 1973): for given decays and frequencies, the weights A and B solve a linear
// least-squares problem with one linear constraint, ∫K = ∫D (kernel K, disk D). Only 2n unknowns remain for the
// Levenberg–Marquardt method (Levenberg 1944, Marquardt 1963). It starts from evenly spread frequencies, and from the
// best kernel with one component fewer, extended by a new component.
//
// Held equal: extent, disk radius 1, gain (∫K = ∫D), error measure. For the published kernels, extent and disk radius
// are chosen to minimise the error.

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <unsupported/Eigen/NumericalDiff>
#include <vector>

#include "core/error.h"
#include "render/circular/circular_kernel.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;
using Kernel = std::vector<CircularComponent>;
using Values = Eigen::VectorXd;

constexpr double pi = std::numbers::pi;

// Kernels of Niemitalo 2010: decay, frequency and the two weights of each component, in Niemitalo's units.
const std::array<Kernel, 5> publishedKernels = {{
    {{0.862325, 1.624835, 0.767583, 1.862321}},
    {{0.886528, 5.268909, 0.411259, -0.548794}, {1.960518, 1.558213, 0.513282, 4.561110}},
    {{2.176490, 5.043495, 1.621035, -2.105439},
     {1.019306, 9.027613, -0.280860, -0.162882},
     {2.815110, 1.597273, -0.366471, 10.300301}},
    {{4.338459, 1.553635, -5.767909, 46.164397},
     {3.839993, 4.693183, 9.795391, -15.227561},
     {2.791880, 8.178137, -3.048324, 0.302959},
     {1.342190, 12.328289, 0.010001, 0.244650}},
    {{4.892608, 1.685979, -22.356787, 85.912460},
     {4.711870, 4.998496, 35.918936, -28.875618},
     {4.052795, 8.244168, -13.212253, -1.578428},
     {2.929212, 11.900859, 0.507991, 1.816328},
     {1.512961, 16.116382, 0.138051, -0.010000}},
}};

// ---- weights of a kernel with given decays and frequencies ------------------------------------------------------

struct Problem {
    Values squaredRadii;  // squared distances of the quadrature nodes from the centre
    Values weights;       // quadrature weights: the area that each node represents
    Values roots;         // square roots of `weights`, increased by `guard` in the square's corners
    Values target;        // values of the disk at the nodes, times `roots`
};

Problem problemOf(double extent, double guard) {
    const std::vector<RadialNode> nodes = squareNodes(extent, 1);
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Problem problem{Values(count), Values(count), Values(count), Values(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const RadialNode& node = nodes[static_cast<std::size_t>(i)];
        // Ratio of the length of a complete ring of radius r to the length of its arcs inside the square. Arcs with a
        // total angle of 8·arccos(extent/r) lie outside.
        const double outward = std::max(1.0, std::sqrt(node.squaredRadius) / extent);
        const double ring = pi / (pi - 4 * std::acos(1 / outward));
        problem.squaredRadii[i] = node.squaredRadius;
        problem.weights[i] = node.weight;
        problem.roots[i] = std::sqrt(node.weight * (outward > 1 ? 1 + guard * ring : 1));
        problem.target[i] = node.squaredRadius < 1 ? problem.roots[i] : 0;
    }
    return problem;
}

struct Fit {
    Values shape;  // decays and frequencies of the components, alternating
    Kernel kernel;
    Values residual;
    double squares = std::numeric_limits<double>::infinity();  // squared norm of the residual
};

// Basis functions of the kernel at the nodes: two columns per component, √weight·e^(−a·u)·cos b·u and
// √weight·e^(−a·u)·sin b·u with u = r², and the integral of each function over the square.
struct Basis {
    Eigen::MatrixXd columns;
    Values energies;
};

Basis basisOf(const Problem& problem, const Values& shape) {
    const auto u = problem.squaredRadii.array();
    Basis basis{Eigen::MatrixXd(u.size(), shape.size()), Values(shape.size())};
    for (Eigen::Index c = 0; c < shape.size(); c += 2) {
        const Eigen::ArrayXd size = (-shape[c] * u).exp();
        basis.columns.col(c) = size * (shape[c + 1] * u).cos();
        basis.columns.col(c + 1) = size * (shape[c + 1] * u).sin();
    }
    basis.energies = basis.columns.transpose() * problem.weights;
    basis.columns = problem.roots.asDiagonal() * basis.columns;
    return basis;
}

// Returns the x that minimises |basis·x − target|² subject to energies·x = energy, by QR. For y = R·x, the constraint
// is (R⁻ᵀ·energies)·y = energy. The unconstrained optimum is projected onto this plane along R⁻ᵀ·energies.
Values constrainedLeastSquares(const Basis& basis, const Values& target, double energy) {
    const Eigen::Index n = basis.energies.size();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis.columns);
    const auto r = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    const Values along = r.transpose().solve(basis.energies);
    Values y = (qr.householderQ().transpose() * target).head(n);
    y += (energy - along.dot(y)) / along.squaredNorm() * along;
    return r.solve(y);
}

Fit fitWeights(const Problem& problem, const Values& shape) {
    const Basis basis = basisOf(problem, shape);
    const Values weights = constrainedLeastSquares(basis, problem.target, pi);
    Fit fit{shape, {}, basis.columns * weights - problem.target};
    fit.squares = fit.residual.squaredNorm();
    for (Eigen::Index c = 0; c < shape.size(); c += 2)
        fit.kernel.push_back({shape[c], shape[c + 1], weights[c], weights[c + 1]});
    return fit;
}

// ---- fit of decays and frequencies ------------------------------------------------------------------------------

struct Residual : Eigen::DenseFunctor<double> {
    Residual(const Problem& fitted, Eigen::Index unknowns)
        : DenseFunctor(static_cast<int>(unknowns), static_cast<int>(fitted.target.size())), problem(fitted) {}
    int operator()(const Values& shape, Values& residual) const {
        residual = fitWeights(problem, shape).residual;
        return 0;
    }
    const Problem& problem;
};

// Runs the Levenberg–Marquardt method with numerical derivatives until a step reduces the error by less than the
// fraction `tolerance`.
Fit fitShape(const Problem& problem, const Values& start, double tolerance) {
    Eigen::NumericalDiff<Residual, Eigen::Central> residual(problem, start.size());
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residual, Eigen::Central>> method(residual);
    method.setFtol(tolerance);
    Values shape = start;
    method.minimize(shape);
    return fitWeights(problem, shape);
}

// Returns the kernel with positive frequencies, its components sorted by frequency and all values rounded to the
// printed digits.
Kernel tidied(Kernel kernel) {
    const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
    for (CircularComponent& c : kernel) {
        const double sign = c.frequency < 0 ? -1 : 1;
        c = {rounded(c.decay), rounded(sign * c.frequency), rounded(c.cosine), rounded(sign * c.sine)};
    }
    std::ranges::sort(kernel, {}, &CircularComponent::frequency);
    return kernel;
}

// Returns the best-fitting kernels with 1, 2, … `count` components.
std::vector<Kernel> fitKernels(double extent, double guard, int count) {
    constexpr double rough = 1e-4;
    constexpr double fine = 1e-10;
    const Problem problem = problemOf(extent, guard);
    std::vector<Kernel> kernels;
    Fit before;
    for (int n = 1; n <= count; ++n) {
        Fit best;
        const auto attempt = [&](const Values& start) {
            Fit fit = fitShape(problem, start, rough);
            if (fit.squares < best.squares) best = std::move(fit);
        };
        for (const double spacing : {3.0, 4.5, 6.0, 7.5}) {
            for (const double decay : {0.5, 2.0}) {
                Values start(2 * n);
                for (int k = 0; k < n; ++k) start.segment<2>(2 * k) << decay, spacing * (k + 0.5);
                attempt(start);
            }
        }
        for (const double frequency : {1.0, 6.0 * n}) {
            Values start(2 * n);
            start << before.shape, 0.5, frequency;
            attempt(start);
        }
        before = fitShape(problem, best.shape, fine);
        kernels.push_back(tidied(before.kernel));
    }
    return kernels;
}

// ---- printed tables ---------------------------------------------------------------------------------------------

struct Ripple {
    double insideMax = 0;  // max |value − 1| of the kernel for r < 0.9
    double insideRms = 0;  // RMS of the kernel's value − 1 for r < 0.9
    double highest = 0;    // max value of the kernel for r > 1.1 within the square
    double lowest = 0;
};

Ripple rippleOf(const Kernel& kernel, double extent) {
    constexpr double inside = 0.9 * 0.9;
    constexpr double outside = 1.1 * 1.1;
    constexpr double step = 1e-4;
    Ripple ripple;
    double squares = 0;
    for (int i = 0; i * step <= 2 * extent * extent; ++i) {
        const double u = i * step;
        const double value = circularProfile(kernel, u);
        if (u < inside) {
            squares += (value - 1) * (value - 1) * step / inside;
            ripple.insideMax = std::max(ripple.insideMax, std::abs(value - 1));
        } else if (u > outside) {
            ripple.highest = std::max(ripple.highest, value);
            ripple.lowest = std::min(ripple.lowest, value);
        }
    }
    ripple.insideRms = std::sqrt(squares);
    return ripple;
}

struct Suited {
    double error = std::numeric_limits<double>::infinity();
    double extent = 0;
    double diskRadius = 0;
};

// Returns the extent in [from, to] and the disk radius near 1.15 that minimise the error of a kernel, to within 0.001.
Suited suitedTo(const Kernel& kernel, double from, double to) {
    constexpr int reach = 20;
    Suited best;
    Suited centre{0, (from + to) / 2, 1.15};
    for (double step = 0.025; step > 0.0005; step /= 5, centre = best) {
        for (int i = -reach; i <= reach; ++i) {
            for (int j = -reach; j <= reach; ++j) {
                const double extent = std::clamp(centre.extent + i * step, from, to);
                const double radius = centre.diskRadius + j * step;
                const double error = diskProfileError(kernel, extent, radius);
                if (error < best.error) best = {error, extent, radius};
            }
        }
    }
    return best;
}

// Returns the kernel rescaled to a disk of radius 1 and to ∫K = ∫D. In these units, its extent is suited.extent /
// suited.diskRadius.
Kernel inRadii(Kernel kernel, const Suited& suited) {
    const double gain = energyGain(kernel, suited.extent, suited.diskRadius);
    const double square = suited.diskRadius * suited.diskRadius;
    for (CircularComponent& c : kernel) c = {square * c.decay, square * c.frequency, gain * c.cosine, gain * c.sine};
    return kernel;
}

double weightSum(const Kernel& kernel) {
    double sum = 0;
    for (const CircularComponent& c : kernel) sum += std::hypot(c.cosine, c.sine);
    return sum;
}

void printConstants(const std::vector<Kernel>& kernels) {
    fmt::print("The table of circular_kernel.cpp: decay, frequency, cosine, sine\n\n");
    for (const Kernel& kernel : kernels) {
        fmt::print("    // {}\n", kernel.size());
        for (const CircularComponent& c : kernel) {
            fmt::print("    {{{:.6f}, {:.6f}, {:.6f}, {:.6f}}},\n", c.decay, c.frequency, c.cosine, c.sine);
        }
    }
}

void printHead(const char* title) {
    fmt::print("\n{}\n\n{:32}{:>17}{:>18}\n", title, "", "inside r < 0.9", "outside r > 1.1");
    fmt::print("{:>2} {:>6} {:>7} {:>8}{:>8} {:>7} {:>8} {:>8} {:>8}\n", "n", "extent", "error", "rounding", "weights",
               "max", "rms", "highest", "lowest");
}

void printRow(const Kernel& kernel, double extent) {
    const Ripple ripple = rippleOf(kernel, extent);
    fmt::print("{:>2} {:>6.3f} {:>7.5f} {:>8.2f}{:>8.2f} {:>7.3f} {:>8.3f} {:>8.3f} {:>8.3f}\n", kernel.size(), extent,
               diskProfileError(kernel, extent, 1), roundingAmplification(kernel, extent, 1), weightSum(kernel),
               ripple.insideMax, ripple.insideRms, ripple.highest, ripple.lowest);
}

void printTables(const std::vector<Kernel>& kernels) {
    constexpr double extent = circularKernelExtent;
    fmt::print(
        "\nLengths in radii of the disk, weights at the gain that keeps the disk's energy.\n"
        "error: RMS over the square relative to the disk; rounding: roundingAmplification; weights: their sum\n");
    printHead("With the corners' guard: the table above");
    for (const Kernel& kernel : kernels) printRow(kernel, extent);
    printHead("Without the guard");
    for (const Kernel& kernel : fitKernels(extent, 0, circularKernelLimit)) printRow(kernel, extent);
    printHead("With the guard, larger extents (the cost of a pass grows with the extent)");
    for (const double larger : {1.03, 1.06, 1.1, 1.2}) {
        for (const Kernel& kernel : fitKernels(larger, circularCornerGuard, 5)) printRow(kernel, larger);
    }
    printHead("Published: extent and disk radius that suit best, then the disk radius that suits extent 1 of theirs");
    for (const Kernel& kernel : publishedKernels) {
        for (const Suited& suited : {suitedTo(kernel, 1, 2), suitedTo(kernel, 1, 1)}) {
            printRow(inRadii(kernel, suited), suited.extent / suited.diskRadius);
            fmt::print("   in its own units extent {:.3f}, disk radius {:.3f}\n", suited.extent, suited.diskRadius);
        }
    }
    printHead("Published, rescaled to the disk as circular_kernel.cpp has them");
    for (int n = 1; n <= publishedKernelLimit; ++n) {
        const auto kernel = rescaledCircularKernel(n);
        printRow(inRadii({kernel.begin(), kernel.end()}, {0, extent, 1}), extent);
    }
}

// Returns whether `kernels` fit as well as the kernels in circular_kernel.cpp: their errors must be equal to within
// 1e-5.
bool agreesWithCommitted(const std::vector<Kernel>& kernels) {
    return std::ranges::all_of(kernels, [](const Kernel& kernel) {
        const auto committed = circularKernel(static_cast<int>(kernel.size()));
        return std::abs(diskProfileError(committed, circularKernelExtent, 1) -
                        diskProfileError(kernel, circularKernelExtent, 1)) < 1e-5;
    });
}

}  // namespace

int main() {
    return defocus::engine::runBench("defocus_circular_fit", [] {
        const auto kernels = fitKernels(circularKernelExtent, circularCornerGuard, circularKernelLimit);
        printConstants(kernels);
        printTables(kernels);
        if (!agreesWithCommitted(kernels)) fail("the table of circular_kernel.cpp differs from this one");
        return 0;
    });
}
