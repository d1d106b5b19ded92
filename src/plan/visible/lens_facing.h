#pragma once
// Whether a triangle shows its back to all of the lens, for any C of its vertices and while they move (Munkberg, Toth
// and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Appendix A, with the opposite sign of
// the determinant: here it is positive if the front shows).
//
// After the shear p + C·(u, k·v, 0), the determinant of the corners (x, y, w) is
//   det + u·Nx + k·v·Ny,   N = Σ Cᵢ·pⱼ × pₖ   (i, j, k cyclic),
// at most det + r·√(Nx² + (k·Ny)²) over the lens points of the disk of radius r (Eq. 5). Where corners and C move
// linearly, det and N are cubic in time (Eq. 7 and 8): Σ B₍m₎(t)·D₍m₎ and Σ B₍m₎(t)·N₍m₎ in Bernstein's polynomials of
// degree 3, which are ≥ 0 and sum to 1. So the largest of D₍m₎ + r·√(N₍m₎x² + (k·N₍m₎y)²) bounds the determinant at all
// times. The bound is exact for what stands still, and at the two ends.

#include <array>
#include <glm/vec3.hpp>

namespace defocus::engine {

struct LensTriangle {
    std::array<glm::dvec3, 3> places;  // (x, y, w) of the pinhole image
    std::array<double, 3> coc{};       // C of the corners
};

// Returns the largest determinant over the lens.
double largestDeterminant(const LensTriangle& triangle, double aspect, double radius = 1);

// Returns a bound of the largest determinant over the lens while places and C go evenly from one triangle to the other.
double largestDeterminant(const LensTriangle& from, const LensTriangle& to, double aspect, double radius = 1);

// The triangle at a share of the way.
LensTriangle between(const LensTriangle& from, const LensTriangle& to, double share);

}  // namespace defocus::engine
