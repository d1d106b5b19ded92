#include "render/circular/circular_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/error.h"

namespace defocus::engine {
namespace {

using Kernel = std::vector<CircularComponent>;

constexpr double pi = std::numbers::pi;

Kernel copyOf(int components) {
    const auto kernel = circularKernel(components);
    return {kernel.begin(), kernel.end()};
}

// Returns the value K(r) of the kernel at r² = squaredRadius.
double profileOf(std::span<const CircularComponent> kernel, double squaredRadius) {
    double sum = 0;
    for (const CircularComponent& c : kernel) {
        const std::complex<double> factor = circularFactor(c, std::sqrt(squaredRadius));
        sum += c.cosine * factor.real() + c.sine * factor.imag();
    }
    return sum;
}

// Integrals of a kernel K(r) over the square [−1, 1]², as midpoint sums. r is the distance from the square's centre.
struct Integrals {
    double kernel = 0;   // ∫K dA
    double disk = 0;     // ∫K dA over the disk of radius 1
    double squares = 0;  // ∫K² dA
    double corners = 0;  // ∫K² du over 1 < u < 2 with u = r², which covers the square's corners
};

Integrals integralsOf(std::span<const CircularComponent> kernel) {
    constexpr int steps = 1000;
    Integrals sums;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        const double inside = profileOf(kernel, t);  // inside the disk, r² = t and dA = π dt
        const double outside = profileOf(kernel, 1 + t * t);
        const double du = 2 * t / steps;
        // area of the part of a thin ring of radius √(1 + t²) inside the square
        const double arcs = (pi - 4 * std::atan(t)) * du;
        sums.disk += pi / steps * inside;
        sums.kernel += pi / steps * inside + arcs * outside;
        sums.squares += pi / steps * inside * inside + arcs * outside * outside;
        sums.corners += outside * outside * du;
    }
    return sums;
}

// Returns the RMS difference of the kernel from the disk of radius 1, relative to the disk's RMS value. The kernel is
// scaled to the disk's integral.
double diskError(std::span<const CircularComponent> kernel) {
    const Integrals sums = integralsOf(kernel);
    const double gain = pi / sums.kernel;
    return std::sqrt((gain * gain * sums.squares - 2 * gain * sums.disk) / pi + 1);
}

TEST(CircularKernel, factorsOfTwoAxesMultiplyToACircle) {
    for (int n = 1; n <= circularKernelLimit; ++n) {
        for (const CircularComponent& c : circularKernel(n)) {
            for (double x = -1; x <= 1; x += 0.125) {
                for (double y = -1; y <= 1; y += 0.125) {
                    const std::complex<double> product = circularFactor(c, x) * circularFactor(c, y);
                    EXPECT_LT(std::abs(product - circularFactor(c, std::hypot(x, y))), 1e-13);
                }
            }
        }
    }
}

TEST(CircularKernel, factorDecaysAndTurns) {
    const CircularComponent quarterTurn{0.5, pi / 2, 3, 7};  // the component's complex factor at radius 1 is e^(−1/2)·i
    EXPECT_NEAR(std::abs(circularFactor(quarterTurn, 1) - std::complex<double>(0, std::exp(-0.5))), 0, 1e-14);
}

TEST(CircularKernel, onlyTheNumbersOfComponentsThereAre) {
    for (int n = 1; n <= circularKernelLimit; ++n) EXPECT_EQ(circularKernel(n).size(), static_cast<std::size_t>(n));
    EXPECT_THROW(circularKernel(0), Error);
    EXPECT_THROW(circularKernel(circularKernelLimit + 1), Error);
}

TEST(CircularKernel, energyIsTheDisks) {
    for (int n = 1; n <= circularKernelLimit; ++n) {
        EXPECT_NEAR(integralsOf(circularKernel(n)).kernel, pi, 2e-5) << n;
    }
}

TEST(CircularKernel, moreComponentsComeCloserToTheDisk) {
    double before = std::numeric_limits<double>::infinity();
    for (int n = 1; n <= circularKernelLimit; ++n) {
        const double error = diskError(circularKernel(n));
        EXPECT_LT(error, 0.95 * before) << n;
        before = error;
    }
}

// The published kernels have the constants of Garcia's slides, with the distance x = tap/8. At the outermost tap
// (x = 1), the formula on the slides gives 0.9245 for the kernel of two components.
TEST(CircularKernel, publishedKernelIsThatOfTheSlides) {
    const auto kernel = circularKernel(2, KernelConstants::published);
    EXPECT_EQ(kernel[0].decay, 0.886528);
    EXPECT_EQ(kernel[1].frequency, 1.558213);
    EXPECT_NEAR(profileOf(kernel, 1), 0.9245, 1e-4);
}

// Rescaled kernels are the published kernels with lengths in units of the radius of the disk that they approximate.
// Kernels scaled to a radius 3 % larger or smaller approximate the disk worse. The kernels that were fitted for this
// program approximate the disk at least as well as the rescaled kernels.
TEST(CircularKernel, rescaledKernelsAreInRadiiOfTheirDisk) {
    EXPECT_THROW(circularKernel(0, KernelConstants::published), Error);
    EXPECT_THROW(circularKernel(publishedKernelLimit + 1, KernelConstants::rescaled), Error);
    const CircularComponent& one = circularKernel(1, KernelConstants::rescaled)[0];
    EXPECT_NEAR(one.decay / one.frequency, 0.862325 / 1.624835, 1e-12);
    EXPECT_EQ(one.cosine, 0.767583);
    EXPECT_EQ(one.sine, 1.862321);
    for (int n = 1; n <= publishedKernelLimit; ++n) {
        const auto kernel = circularKernel(n, KernelConstants::rescaled);
        const double error = diskError(kernel);
        for (const double factor : {0.97, 1.03}) {
            Kernel other{kernel.begin(), kernel.end()};
            for (CircularComponent& c : other) {
                c.decay *= factor * factor;
                c.frequency *= factor * factor;
            }
            EXPECT_GT(diskError(other), error) << n << ", " << factor;
        }
        EXPECT_LE(diskError(circularKernel(n)), error) << n;
        // With a mistyped constant, the kernel would fit no disk, or fit worse than the kernel with one component
        // fewer.
        EXPECT_LT(error, n == 1 ? 0.25 : diskError(circularKernel(n - 1, KernelConstants::rescaled)));
    }
}

// Negative lobes of a kernel darken the surroundings of a highlight. The rescaled kernels have shallower lobes than the
// fitted kernels.
TEST(CircularKernel, rescaledKernelsDipLess) {
    const auto lowest = [](std::span<const CircularComponent> kernel) {
        double value = 0;
        for (double u = 0; u <= 2; u += 1e-3) value = std::min(value, profileOf(kernel, u));
        return value * pi / integralsOf(kernel).kernel;
    };
    for (int n = 2; n <= publishedKernelLimit; ++n)
        EXPECT_GT(lowest(circularKernel(n, KernelConstants::rescaled)), 0.4 * lowest(circularKernel(n))) << n;
}

// Returns the objective that the fitted kernels minimize (see circular_kernel.h).
double guardedSquares(const Kernel& kernel) {
    const Integrals sums = integralsOf(kernel);
    const double gain = pi / sums.kernel;
    return gain * gain * (sums.squares + 0.2 * pi * sums.corners) - 2 * gain * sums.disk + pi;
}

TEST(CircularKernel, noSmallChangeComesCloser) {
    double CircularComponent::*const fields[] = {&CircularComponent::decay, &CircularComponent::frequency,
                                                 &CircularComponent::cosine, &CircularComponent::sine};
    for (int n = 1; n <= circularKernelLimit; ++n) {
        const double best = guardedSquares(copyOf(n));
        for (std::size_t c = 0; c < static_cast<std::size_t>(n); ++c) {
            for (double CircularComponent::*const field : fields) {
                for (const double factor : {0.995, 1.005}) {
                    Kernel changed = copyOf(n);
                    changed[c].*field *= factor;
                    EXPECT_GT(guardedSquares(changed), best - 1e-9) << n << ": component " << c;
                }
            }
        }
    }
}

constexpr int blurRadius = 40;  // radius of the disk, px
constexpr int side = 100;       // side of the image, px
using Field = std::vector<std::complex<double>>;

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
}

Field filtered(const Field& in, const CircularComponent& component, int stepX, int stepY) {
    const int reach = blurRadius;
    Field out(in.size());
    for (int tap = -reach; tap <= reach; ++tap) {
        const std::complex<double> weight = circularFactor(component, double(tap) / blurRadius);
        for (int y = std::max(0, -tap * stepY); y < std::min(side, side - tap * stepY); ++y) {
            for (int x = std::max(0, -tap * stepX); x < std::min(side, side - tap * stepX); ++x) {
                out[at(x, y)] += weight * in[at(x + tap * stepX, y + tap * stepY)];
            }
        }
    }
    return out;
}

std::vector<double> blurredBySeparablePasses(const Field& in, int components) {
    std::vector<double> out(in.size());
    for (const CircularComponent& c : circularKernel(components)) {
        const Field both = filtered(filtered(in, c, 1, 0), c, 0, 1);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += c.cosine * both[i].real() + c.sine * both[i].imag();
    }
    return out;
}

TEST(CircularKernel, rowsThenColumnsDrawTheKernelAroundEachPoint) {
    struct Point {
        int x, y;
        double light;
    };
    // the kernel's supports around the two points overlap; the image border cuts the second support
    const Point points[] = {{45, 52, 1}, {61, 20, 2.5}};
    Field in(side * side);
    for (const Point& point : points) in[at(point.x, point.y)] = point.light;
    for (const int n : {1, 2, 5, 9}) {
        const std::vector<double> out = blurredBySeparablePasses(in, n);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                double expected = 0;
                for (const Point& point : points) {
                    const double dx = double(x - point.x) / blurRadius;
                    const double dy = double(y - point.y) / blurRadius;
                    if (std::max(std::abs(dx), std::abs(dy)) > 1) continue;
                    expected += point.light * profileOf(circularKernel(n), dx * dx + dy * dy);
                }
                ASSERT_NEAR(out[at(x, y)], expected, 1e-11) << n << " components at " << x << ", " << y;
            }
        }
    }
}

// The blur of a point has the RMS radius of a disk, radius/√2.
TEST(CircularKernel, blurIsAsWideAsTheDisk) {
    Field in(side * side);
    in[at(side / 2, side / 2)] = 1;
    for (int n = 1; n <= circularKernelLimit; ++n) {
        const std::vector<double> out = blurredBySeparablePasses(in, n);
        double sum = 0;
        double moment = 0;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int dx = x - side / 2;
                const int dy = y - side / 2;
                sum += out[at(x, y)];
                moment += (dx * dx + dy * dy) * out[at(x, y)];
            }
        }
        const double width = std::sqrt(moment / sum) / (blurRadius / std::numbers::sqrt2);
        EXPECT_NEAR(width, 1, 0.001) << n;
    }
}

}  // namespace
}  // namespace defocus::engine
