// Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia 2018, Circular Separable Convolution Depth of
// Field.

#include "render/circular_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace defocus {

namespace {

constexpr int nodesPerPiece = 64;

// kernels

// x in (−1, 1) and weight of point i of n (Newton's iteration on the Legendre polynomial P_n from Tricomi's guess).
std::pair<double, double> gaussLegendre(int i, int n) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
        double value = x;
        double before = 1;
        for (int k = 2; k <= n; ++k) before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
        slope = n * (x * value - before) / (x * x - 1);
        x -= value / slope;
    }
    return {x, 2 / ((1 - x * x) * slope * slope)};
}

// visit(t, dt) over [begin, end]; nothing where the interval is empty.
template <typename Visit>
void forEachNode(double begin, double end, const Visit& visit) {
    if (!(begin < end)) return;
    for (int i = 0; i < nodesPerPiece; ++i) {
        const auto [x, weight] = gaussLegendre(i, nodesPerPiece);
        visit((begin + end) / 2 + x * (end - begin) / 2, weight * (end - begin) / 2);
    }
}

double integral(std::span<const RadialNode> nodes, std::span<const CircularComponent> kernel) {
    double sum = 0;
    for (const RadialNode& node : nodes) sum += node.weight * circularProfile(kernel, node.squaredRadius);
    return sum;
}

}  // namespace

std::span<const CircularComponent> circularKernel(int components) {
    return {};
}

std::complex<double> circularFactor(const CircularComponent& component, double offset) {
    return std::exp(std::complex<double>(-component.decay, component.frequency) * (offset * offset));
}

double circularProfile(std::span<const CircularComponent> kernel, double squaredRadius) {
    double sum = 0;
    for (const CircularComponent& c : kernel) {
        const double angle = c.frequency * squaredRadius;
        sum += std::exp(-c.decay * squaredRadius) * (c.cosine * std::cos(angle) + c.sine * std::sin(angle));
    }
    return sum;
}

std::vector<RadialNode> squareNodes(double extent, double edge) {
    const double square = extent * extent;
    std::vector<RadialNode> nodes;
    // Whole circles, u = r² < extent²: dA = π du.
    const auto circle = [&](double u, double du) { nodes.push_back({u, std::numbers::pi * du}); };
    const double inside = std::min(edge * edge, square);
    forEachNode(0, inside, circle);
    forEachNode(inside, square, circle);
    // Arcs in the corners, u = extent² + t²: each side hides the angle 2·arccos(extent/r) = 2·arctan(t/extent).
    const auto arcs = [&](double t, double dt) {
        nodes.push_back({square + t * t, (std::numbers::pi - 4 * std::atan(t / extent)) * 2 * t * dt});
    };
    const double corner = std::clamp(std::sqrt(std::max(0.0, edge * edge - square)), 0.0, extent);
    forEachNode(0, corner, arcs);
    forEachNode(corner, extent, arcs);
    return nodes;
}

double energyGain(std::span<const CircularComponent> kernel, double extent, double diskRadius) {
    return std::numbers::pi * diskRadius * diskRadius / integral(squareNodes(extent, diskRadius), kernel);
}

double diskProfileError(std::span<const CircularComponent> kernel, double extent, double diskRadius) {
    const std::vector<RadialNode> nodes = squareNodes(extent, diskRadius);
    const double disk = std::numbers::pi * diskRadius * diskRadius;
    const double gain = disk / integral(nodes, kernel);
    double squares = 0;
    double covered = 0;  // area of the disk inside the square
    for (const RadialNode& node : nodes) {
        const double target = node.squaredRadius < diskRadius * diskRadius ? 1 : 0;
        const double deviation = gain * circularProfile(kernel, node.squaredRadius) - target;
        squares += node.weight * deviation * deviation;
        covered += node.weight * target;
    }
    return std::sqrt((squares + std::max(0.0, disk - covered)) / disk);
}

double roundingAmplification(std::span<const CircularComponent> kernel, double extent, double diskRadius) {
    double sum = 0;
    for (const CircularComponent& c : kernel) sum += std::hypot(c.cosine, c.sine);
    return std::abs(energyGain(kernel, extent, diskRadius)) * sum;
}

}  // namespace defocus
