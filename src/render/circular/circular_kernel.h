#pragma once
// Disk-shaped blur by separable complex filters (Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia
// 2018, Circular Separable Convolution Depth of Field).
//
// A component is F(x) = e^(−a·x²)·(cos(b·x²) + i·sin(b·x²)), where x is the offset divided by the disk's radius.
// F(x)·F(y) = F(√(x² + y²)), so one complex pass along rows and one along columns apply a circular kernel. With u = r²,
// the weighted sum over the components c,
//     K(r) = Σ_c [A·Re F(r) + B·Im F(r)] = Σ_c e^(−a·u)·(A·cos(b·u) + B·sin(b·u)),
// approximates the disk D(r) = 1 for r < 1, 0 beyond. The passes visit taps with |x| ≤ 1, so the kernel's support is
// the square [−1, 1]². All integrals below are over this square.

#include <complex>
#include <span>

namespace defocus::engine {

struct CircularComponent {
    // Rates a and b (radians) of the component's factors e^(−a·x²) and cos(b·x²) + i·sin(b·x²); x is the offset in disk
    // radii.
    double decay;
    double frequency;
    double cosine;  // weight A of the component's real part, e^(−a·x²)·cos(b·x²)
    double sine;    // weight B of the component's imaginary part, e^(−a·x²)·sin(b·x²)
};

inline constexpr int circularKernelLimit = 9;   // max number of components of a fitted kernel
inline constexpr int publishedKernelLimit = 5;  // max number of components of a published kernel (Niemitalo 2010)

enum class KernelConstants {
    // The kernel K that best fits the disk D of radius 1 with ∫K = ∫D. The fit minimizes ∫(K − D)² dA over the square,
    // plus 0.2·π·∫K² du over 1 < u < 2, where u = r². The second term penalizes the square's corners (u → 2), whose
    // small area hardly matters in the first term. Without the second term, K falls to −0.4 … −0.7 in the corners, and
    // each highlight has four dark dots around it.
    fitted,
    // The published kernel, rescaled to the disk of radius 1 (`scripts/figures circular-fit` prints the original
    // radii). The blur passes divide by the sum of the tap weights. After this division, the kernel's integral equals
    // the disk's area.
    rescaled,
    // Niemitalo's constants (2010), for eight taps on each side of the centre, at the offsets x = tap/8. The kernel
    // with two components is as printed in Garcia's slides; the others are as in Garcia's public filter generator. The
    // slides also print e^(−a·x²) with negative a, which grows with x; here a is positive. The kernels approximate
    // disks of radii 1.07 to 1.10. The taps cover only the square [−1, 1]², which cuts off the edges of these disks.
    published,
};

// Returns the kernel with `count` components: 1 to circularKernelLimit for a fitted kernel, 1 to publishedKernelLimit
// for a published or rescaled kernel. Throws Error if `count` is out of range. The data have static lifetime.
std::span<const CircularComponent> circularKernel(int count, KernelConstants constants = KernelConstants::fitted);

// Returns the complex value F(x) of a component at the tap with the offset x = `offset`, in disk radii.
std::complex<double> circularFactor(const CircularComponent& component, double offset);

}  // namespace defocus::engine
