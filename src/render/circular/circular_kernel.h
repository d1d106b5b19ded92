#pragma once
// Disk-shaped blur by separable complex filters (Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia
// 2018, Circular Separable Convolution Depth of Field).
//
// A component is F(x) = e^(−a·x²)·(cos b·x² + i·sin b·x²), where x is the offset divided by the disk's radius.
// F(x)·F(y) = F(√(x² + y²)), so one complex pass along rows and one along columns apply a circular kernel. With u = r²,
// the weighted sum over the components c,
//     K(r) = Σ_c [A·Re F(r) + B·Im F(r)] = Σ_c e^(−a·u)·(A·cos b·u + B·sin b·u),
// approximates the disk D(r) = 1 for r < 1, 0 beyond. The passes visit taps with |x| ≤ extent, so the kernel's support
// is the square [−extent, extent]². All integrals below are over this square.

#include <complex>
#include <span>
#include <vector>

namespace defocus::engine {

struct CircularComponent {
    double decay;      // decay a of F(x), per squared radius
    double frequency;  // frequency b of F(x), radians per squared radius
    double cosine;     // weight A of the real part of F(x)
    double sine;       // weight B of the imaginary part of F(x)
};

inline constexpr int circularKernelLimit = 9;        // max components of circularKernel()
inline constexpr double circularKernelExtent = 1.0;  // extent for which circularKernel() is fitted
inline constexpr double circularCornerGuard = 0.2;   // weight of the corner penalty; see circularKernel

// Returns the kernel K of `count` components, 1 to circularKernelLimit, that best fits the disk D of radius 1 with ∫K =
// ∫D. The fit minimizes ∫(K − D)² dA over the square, plus circularCornerGuard·π·∫K² du over 1 < u < 2, where u = r².
// The second term penalizes the square's corners (u → 2), whose small area hardly matters in the first term. Without
// the second term, K falls to −0.4 … −0.7 in the corners, and each highlight has four dark dots around it. Throws Error
// for another `count`. The data have static lifetime.
std::span<const CircularComponent> circularKernel(int count);

inline constexpr int publishedKernelLimit = 5;  // max components of the kernels of Niemitalo 2010

// Returns the kernel of `count` components, 1 to publishedKernelLimit, with Niemitalo's constants (2010) as they are
// printed, for offsets x = tap/8. Garcia's slides print the table of two components; the other kernels come from
// Garcia's public filter generator. The slides also print e^(−a·x²) with negative a, which grows with x; here a is
// positive. The kernels approximate disks of radii 1.07 to 1.10, so the square cuts these disks off. Throws Error for
// another `count`. The data have static lifetime.
std::span<const CircularComponent> publishedCircularKernel(int count);

// Returns the published kernel of `count` components, rescaled to the disk of radius 1 (defocus_circular_fit prints the
// original radii). The kernel's integral equals the disk's area after the passes divide by the sum of their taps.
// Throws Error for another `count`. The data have static lifetime.
std::span<const CircularComponent> rescaledCircularKernel(int count);

// Returns F(offset): the complex weight of the tap at `offset`, in disk radii.
std::complex<double> circularFactor(const CircularComponent& component, double offset);

// Returns the value K(r) of the kernel at r² = squaredRadius.
double circularProfile(std::span<const CircularComponent> kernel, double squaredRadius);

// Quadrature node for functions f of r² over the square: ∫f dA = Σ weight·f(squaredRadius).
struct RadialNode {
    double squaredRadius;
    double weight;  // area that the node stands for
};

// Returns quadrature nodes over the square [−extent, extent]², for functions of r² that are smooth except for a jump at
// r = `edge` (> 0). Integrals are exact except for rounding for frequencies up to about 60 per squared extent.
std::vector<RadialNode> squareNodes(double extent, double edge);

// Returns the gain g such that g times the integral of the kernel over the square [−extent, extent]² equals the area of
// the disk of radius diskRadius.
double energyGain(std::span<const CircularComponent> kernel, double extent, double diskRadius);

// Returns the relative RMS error of the kernel K from the disk D, √(∫(g·K − D)² dA / ∫D² dA) with g = energyGain. The
// integral includes the part of the disk outside the square, where K is 0.
double diskProfileError(std::span<const CircularComponent> kernel, double extent, double diskRadius);

// Returns the amplification m of rounding errors: g·Σ_c √(A² + B²)·(∫|F| dx)² / ∫D over |x| ≤ extent, for components c
// with factor F and weights A and B, disk D and g = energyGain. A relative rounding error ε (half float: 2⁻¹¹) of the
// values between the two passes changes the result by at most ε · m times the brightest pixel.
double roundingAmplification(std::span<const CircularComponent> kernel, double extent, double diskRadius);

}  // namespace defocus::engine
