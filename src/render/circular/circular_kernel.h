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

namespace defocus::engine {

struct CircularComponent {
    double decay;      // a, per squared radius
    double frequency;  // b, radians per squared radius
    double cosine;     // A, weight of the real part
    double sine;       // B, weight of the imaginary part
};

inline constexpr int circularKernelLimit = 9;        // components of the largest kernel
inline constexpr double circularKernelExtent = 1.0;  // of the kernels of circularKernel, in radii of the disk
inline constexpr double circularCornerGuard = 0.2;   // see circularKernel

// The kernel of that many components, 1 to circularKernelLimit, that comes closest to the disk of radius 1 with
// ∫K = ∫D: the least ∫(K − D)² dA over the square of the extent above, where the corners count once more as
// circularCornerGuard·π·∫K² du over 1 < u < 2. (The square's arcs vanish towards its corners, u → 2. Left unguarded, K
// falls to −0.4 … −0.7 there, four dark dots around each highlight.) Throws Error outside that range. The data live as
// long as the program.
std::span<const CircularComponent> circularKernel(int count);

inline constexpr int publishedKernelLimit = 5;  // components of the largest published kernel

// The kernel of 1 to publishedKernelLimit components with Niemitalo's constants (2010), of which Garcia's slides print
// the first two. They are given there for a disk of another radius; here that radius is 1, the one for which they come
// closest to a disk (defocus_circular_fit prints both radii). ∫K = ∫D holds once the passes have divided by the sum of
// their taps. Throws Error for other numbers of components. The data live as long as the program.
std::span<const CircularComponent> publishedCircularKernel(int count);

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

// A relative rounding ε of what is stored between the rows' and the columns' pass (half float: 2⁻¹¹) changes the result
// by at most ε · this · the brightest pixel: g·Σ_c √(A² + B²)·(∫|F| dx)² / ∫D over |x| ≤ extent, with g = energyGain.
double roundingAmplification(std::span<const CircularComponent> kernel, double extent, double diskRadius);

}  // namespace defocus::engine
