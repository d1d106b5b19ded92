#include "render/circular/circular_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace defocus::engine {
namespace {

using Kernel = std::vector<CircularComponent>;

constexpr double pi = std::numbers::pi;

Kernel copyOf(int components) {
    const auto kernel = circularKernel(components);
    return {kernel.begin(), kernel.end()};
}

// Returns ∫ e^(−decay·r²) over the square [−extent, extent]².
double gaussianOverSquare(double decay, double extent) {
    const double line = std::sqrt(pi / decay) * std::erf(extent * std::sqrt(decay));
    return line * line;
}

template <typename Function>
double integralOverSquare(double extent, double edge, const Function& function) {
    double sum = 0;
    for (const RadialNode& node : squareNodes(extent, edge)) sum += node.weight * function(node.squaredRadius);
    return sum;
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

TEST(CircularKernel, profileIsTheWeightedSumOfRealAndImaginaryParts) {
    const CircularComponent quarterTurn{0.5, pi / 2, 3, 7};  // the component's complex factor at radius 1 is e^(−1/2)·i
    EXPECT_NEAR(circularProfile({&quarterTurn, 1}, 1), 7 * std::exp(-0.5), 1e-14);
    EXPECT_NEAR(circularProfile({&quarterTurn, 1}, 0), 3, 1e-14);
    EXPECT_NEAR(std::abs(circularFactor(quarterTurn, 1) - std::complex<double>(0, std::exp(-0.5))), 0, 1e-14);
}

TEST(CircularKernel, onlyTheNumbersOfComponentsThereAre) {
    for (int n = 1; n <= circularKernelLimit; ++n) EXPECT_EQ(circularKernel(n).size(), static_cast<std::size_t>(n));
    EXPECT_THROW(circularKernel(0), Error);
    EXPECT_THROW(circularKernel(circularKernelLimit + 1), Error);
}

TEST(CircularKernel, nodesIntegrateOverTheSquare) {
    for (const double extent : {1.0, 1.3}) {
        // `edge` is the radius of a disk that lies inside the square, touches it, reaches beyond its sides, or contains
        // it.
        for (const double edge : {0.5, 1.0, 1.2, 1.5, 2.5}) {
            EXPECT_NEAR(integralOverSquare(extent, edge, [](double) { return 1; }), 4 * extent * extent, 1e-12);
            EXPECT_NEAR(integralOverSquare(extent, edge, [](double u) { return u; }), 8.0 / 3 * std::pow(extent, 4),
                        1e-12);
        }
    }
    // Area of the disk without its four segments outside the square.
    const double edge = 1.2;
    const double angle = std::acos(1 / edge);
    const double segment = edge * edge * angle - edge * std::sin(angle);
    EXPECT_NEAR(integralOverSquare(1, edge, [&](double u) { return u < edge * edge ? 1 : 0; }),
                pi * edge * edge - 4 * segment, 1e-12);
}

// The error of a single Gaussian K(r) = e^(−a·r²) of any weight agrees with closed forms. ∫K² and ∫K over the square
// are error functions, and ∫K over a disk of radius ρ inside the square is π·(1 − e^(−a·ρ²))/a.
TEST(CircularKernel, errorOfAGaussianInClosedForm) {
    for (const double decay : {0.7, 2.0}) {
        for (const double extent : {1.0, 1.25}) {
            const Kernel kernel = {{decay, 0, 5, 0}};
            const double over = gaussianOverSquare(decay, extent);
            const double square = gaussianOverSquare(2 * decay, extent);
            const double radius = 0.9;
            double disk = pi * radius * radius;
            double gain = disk / over;
            const double both = pi * (1 - std::exp(-decay * radius * radius)) / decay;
            EXPECT_NEAR(energyGain(kernel, extent, radius), gain / 5, 1e-13);
            EXPECT_NEAR(diskProfileError(kernel, extent, radius),
                        std::sqrt((gain * gain * square - 2 * gain * both + disk) / disk), 1e-12);

            // If the square lies inside the disk, the disk's part outside the square counts fully as error.
            const double wide = 2 * extent;
            disk = pi * wide * wide;
            gain = disk / over;
            EXPECT_NEAR(diskProfileError(kernel, extent, wide),
                        std::sqrt((gain * gain * square - 2 * gain * over + disk) / disk), 1e-12);
        }
    }
}

// roundingAmplification() is 1 for a Gaussian of positive weight. If components partly cancel, it is the sum of the
// components' magnitudes divided by the magnitude of their sum.
TEST(CircularKernel, roundingIsAmplifiedWhereComponentsCancel) {
    const Kernel one = {{1.5, 0, 4, 0}};
    EXPECT_NEAR(roundingAmplification(one, 1, 1), 1, 1e-12);
    const Kernel cancelling = {{1.5, 0, 4, 0}, {1.5, 0, 0, 9}, {1.5, 0, -3, 0}};
    EXPECT_NEAR(roundingAmplification(cancelling, 1, 1), (4 + 9 + 3) / (4.0 - 3.0), 1e-11);
}

TEST(CircularKernel, energyIsTheDisks) {
    for (int n = 1; n <= circularKernelLimit; ++n) {
        EXPECT_NEAR(energyGain(circularKernel(n), circularKernelExtent, 1), 1, 2e-6) << n;
    }
}

// Half floats have a relative rounding error of 2⁻¹¹ = 0.05 %. If the kernel amplifies it by less than 5, the blurred
// image's error stays below 0.25 % of the brightest pixel.
TEST(CircularKernel, halfFloatsSuffice) {
    for (int n = 1; n <= circularKernelLimit; ++n) {
        EXPECT_LT(roundingAmplification(circularKernel(n), circularKernelExtent, 1), 5) << n;
    }
    for (int n = 1; n <= 3; ++n)  // 32-bit floats store the results of Niemitalo's kernels of 4 or more components
        EXPECT_LT(roundingAmplification(publishedCircularKernel(n), circularKernelExtent, 1), 5) << n;
}

TEST(CircularKernel, moreComponentsComeCloserToTheDisk) {
    double before = std::numeric_limits<double>::infinity();
    for (int n = 1; n <= circularKernelLimit; ++n) {
        const double error = diskProfileError(circularKernel(n), circularKernelExtent, 1);
        EXPECT_LT(error, 0.95 * before) << n;
        before = error;
    }
}

// The project's fitted kernels approximate a disk at least as well as Niemitalo's kernels. Each of his kernels is
// compared at its best extent and disk radius.
TEST(CircularKernel, noFurtherFromTheDiskThanThePublishedKernels) {
    const std::vector<Kernel> published = {
        {{0.862325, 1.624835, 0.767583, 1.862321}},
        {{0.886528, 5.268909, 0.411259, -0.548794}, {1.960518, 1.558213, 0.513282, 4.561110}}};
    for (const Kernel& kernel : published) {
        double min = std::numeric_limits<double>::infinity();
        for (double extent = 1; extent < 2; extent += 0.01) {
            for (double radius = 0.9; radius < 1.4; radius += 0.005) {
                min = std::min(min, diskProfileError(kernel, extent, radius));
            }
        }
        const auto ours = circularKernel(static_cast<int>(kernel.size()));
        EXPECT_LE(diskProfileError(ours, circularKernelExtent, 1), min) << kernel.size();
        EXPECT_LT(min, 0.25) << "not a disk: a published constant is mistyped";
    }
}

// The published kernel has the constants of Garcia's slides, with the distance x = tap/8. At the outermost tap, the
// kernel of two components is 0.9245 by the printed formula.
TEST(CircularKernel, publishedKernelIsThatOfTheSlides) {
    const auto kernel = publishedCircularKernel(2);
    EXPECT_EQ(kernel[0].decay, 0.886528);
    EXPECT_EQ(kernel[1].frequency, 1.558213);
    EXPECT_NEAR(circularProfile(kernel, 1), 0.9245, 1e-4);
}

// Rescaled kernels are the published ones in units of the radius of the disk that they approximate. With the extent
// fixed, a radius 3 % larger or smaller fits a disk worse.
TEST(CircularKernel, rescaledKernelsAreInRadiiOfTheirDisk) {
    EXPECT_THROW(publishedCircularKernel(0), Error);
    EXPECT_THROW(rescaledCircularKernel(publishedKernelLimit + 1), Error);
    const CircularComponent& one = rescaledCircularKernel(1)[0];
    EXPECT_NEAR(one.decay / one.frequency, 0.862325 / 1.624835, 1e-12);
    EXPECT_EQ(one.cosine, 0.767583);
    EXPECT_EQ(one.sine, 1.862321);
    for (int n = 1; n <= publishedKernelLimit; ++n) {
        const auto kernel = rescaledCircularKernel(n);
        const double error = diskProfileError(kernel, circularKernelExtent, 1);
        for (const double factor : {0.97, 1.03}) {
            Kernel other{kernel.begin(), kernel.end()};
            for (CircularComponent& c : other) {
                c.decay *= factor * factor;
                c.frequency *= factor * factor;
            }
            EXPECT_GT(diskProfileError(other, circularKernelExtent, 1), error) << n << ", " << factor;
        }
        // A mistyped constant would fit no disk, or fit worse than the kernel with one component less.
        EXPECT_LT(error, n == 1 ? 0.25 : diskProfileError(rescaledCircularKernel(n - 1), circularKernelExtent, 1));
    }
}

// Negative lobes of a kernel darken the surroundings of a highlight. The rescaled kernels have shallower lobes than the
// fitted kernels.
TEST(CircularKernel, rescaledKernelsDipLess) {
    const auto lowest = [](std::span<const CircularComponent> kernel) {
        double value = 0;
        for (double u = 0; u <= 2; u += 1e-3) value = std::min(value, circularProfile(kernel, u));
        return value * energyGain(kernel, circularKernelExtent, 1);
    };
    for (int n = 2; n <= publishedKernelLimit; ++n)
        EXPECT_GT(lowest(rescaledCircularKernel(n)), 0.4 * lowest(circularKernel(n))) << n;
}

// Returns the objective that the fitted kernels minimize (see circular_kernel.h).
double guardedSquares(const Kernel& kernel) {
    const double error = diskProfileError(kernel, circularKernelExtent, 1);
    const double gain = energyGain(kernel, circularKernelExtent, 1);
    constexpr int steps = 500;
    double corners = 0;
    for (int i = 0; i < steps; ++i) {
        const double value = gain * circularProfile(kernel, 1 + (i + 0.5) / steps);
        corners += value * value / steps;
    }
    return pi * error * error + circularCornerGuard * pi * corners;
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

// ---- separable passes, tap by tap -------------------------------------------------------------------------------

constexpr int blurRadius = 40;  // radius of the disk, px
constexpr int side = 100;       // side of the image, px
using Field = std::vector<std::complex<double>>;

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
}

Field filtered(const Field& in, const CircularComponent& component, int stepX, int stepY) {
    const int reach = static_cast<int>(circularKernelExtent * blurRadius);
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
    // the kernels' supports around both points overlap; the image border cuts the second one
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
                    if (std::max(std::abs(dx), std::abs(dy)) > circularKernelExtent) continue;
                    expected += point.light * circularProfile(circularKernel(n), dx * dx + dy * dy);
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
