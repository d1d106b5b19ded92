#pragma once
// Disk-shaped blur by separable complex filters (Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia
// 2018, Circular Separable Convolution Depth of Field).
//
// A component is F(x) = e^(−a·x²)·(cos b·x² + i·sin b·x²), x the offset over the disk's radius. Because
// F(x)·F(y) = F(√(x² + y²)), one complex pass along the rows and one along the columns filter with a circular kernel,
// and the weighted sum over the components c, with u = r²,
//     K(r) = Σ_c [A·Re F(r) + B·Im F(r)] = Σ_c e^(−a·u)·(A·cos b·u + B·sin b·u),
// approximates the disk D(r) = 1 for r < 1, 0 beyond. The passes visit the taps |x| ≤ extent, so the kernel's support
// is the square [−extent, extent]²; it is the square that is measured here.

#include <complex>
#include <span>
#include <vector>

namespace defocus {

struct CircularComponent {
    double decay;      // a, per squared radius
    double frequency;  // b, radians per squared radius
    double cosine;     // A, weight of the real part
    double sine;       // B, weight of the imaginary part
};

inline constexpr int circularKernelLimit = 9;       // components of the largest kernel
inline constexpr double circularKernelExtent = 1;  // of the kernels of circularKernel, in radii of the disk

// The best kernel of that many components, 1 to circularKernelLimit, for a disk of radius 1 and the extent above, with
// ∫K = ∫D over the square. Throws Error outside that range. The data live as long as the program.
std::span<const CircularComponent> circularKernel(int components);

// F(x): the complex weight of the tap at `offset` radii.
std::complex<double> circularFactor(const CircularComponent& component, double offset);

// K at r² = squaredRadius.
double circularProfile(std::span<const CircularComponent> kernel, double squaredRadius);

// Points of an integral over the square of a function of r²: ∫f dA = Σ weight·f(squaredRadius).
struct RadialNode {
    double squaredRadius;
    double weight;  // area
};

// Gauss–Legendre nodes over the square [−extent, extent]², of functions that are smooth but for a jump at the circle of
// radius `edge` (> 0). Exact to rounding for frequencies up to about 60 per squared extent.
std::vector<RadialNode> squareNodes(double extent, double edge);

// The gain g that makes g·∫K over the square the area of the disk of radius diskRadius.
double energyGain(std::span<const CircularComponent> kernel, double extent, double diskRadius);

// Root mean square deviation from the disk, relative to the disk: √(∫(g·K − D)² dA / ∫D² dA) with g = energyGain, over
// the square and the part of the disk that sticks out of it, where K is 0.
double diskProfileError(std::span<const CircularComponent> kernel, double extent, double diskRadius);

// How much larger than the result's the components' own weights are: Σ_c √(A² + B²) of the kernel at gain g (K = 1 in
// the disk). Rounding of the pass between rows and columns, relative to the brightest pixel, is at most
// 4/π·extent²/diskRadius² times as much larger in the result.
double roundingAmplification(std::span<const CircularComponent> kernel, double extent, double diskRadius);

}  // namespace defocus
