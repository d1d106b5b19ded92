#pragma once
// Disk-shaped blur by separable complex filters (Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia
// 2018, Circular Separable Convolution Depth of Field).
//
// A component is F(x) = e^(−a·x²)·(cos b·x² + i·sin b·x²), where x is the offset divided by the disk's radius.
// F(x)·F(y) = F(√(x² + y²)), so one complex pass along rows and one along columns apply a circular kernel. With u = r²,
// the weighted sum over the components c,
//     K(r) = Σ_c [A·Re F(r) + B·Im F(r)] = Σ_c e^(−a·u)·(A·cos b·u + B·sin b·u),
// approximates the disk D(r) = 1 for r < 1, 0 beyond. The passes visit taps with |x| ≤ 1, so the kernel's support is
// the square [−1, 1]². All integrals below are over this square.

#include <complex>
#include <span>

namespace defocus::engine {

struct CircularComponent {
    double decay;      // decay a of F(x), per squared radius
    double frequency;  // frequency b of F(x), radians per squared radius
    double cosine;     // weight A of the real part of F(x)
    double sine;       // weight B of the imaginary part of F(x)
};

inline constexpr int circularKernelLimit = 9;   // max components of the fitted kernels
inline constexpr int publishedKernelLimit = 5;  // max components of the other kernels

enum class KernelConstants {
    // The kernel K that best fits the disk D of radius 1 with ∫K = ∫D. The fit minimizes ∫(K − D)² dA over the square,
    // plus 0.2·π·∫K² du over 1 < u < 2, where u = r². The second term penalizes the square's corners (u → 2), whose
    // small area hardly matters in the first term. Without the second term, K falls to −0.4 … −0.7 in the corners, and
    // each highlight has four dark dots around it.
    fitted,
    // The published kernel, rescaled to the disk of radius 1 (`scripts/figures circular-fit` prints the original
    // radii). The kernel's integral equals the disk's area after the passes divide by the sum of their taps.
    rescaled,
    // Niemitalo's constants (2010) as they are printed, for offsets x = tap/8. Garcia's slides print the table of two
    // components; the other kernels come from Garcia's public filter generator. The slides also print e^(−a·x²) with
    // negative a, which grows with x; here a is positive. The kernels approximate disks of radii 1.07 to 1.10, so the
    // square cuts these disks off.
    published,
};

// Returns the kernel of `count` components, 1 to circularKernelLimit or publishedKernelLimit. Throws Error for another
// `count`. The data have static lifetime.
std::span<const CircularComponent> circularKernel(int count, KernelConstants constants = KernelConstants::fitted);

// Returns F(offset): the complex weight of the tap at `offset`, in disk radii.
std::complex<double> circularFactor(const CircularComponent& component, double offset);

}  // namespace defocus::engine
