#pragma once
// Tests whether a triangle faces away from the entire lens, for any circles of confusion C of its corners and during
// motion. Source: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization,
// Appendix A. The determinant has the opposite sign here: it is positive if the front face is visible.
//
// After the shear p + C·(u, k·v, 0), the determinant of the corners (x, y, w) is
//   det + u·Nx + k·v·Ny,   N = Σ Cᵢ·pⱼ × pₖ   (i, j, k cyclic).
// Its maximum over the lens points of the disk of radius r is det + r·√(Nx² + (k·Ny)²) (Eq. 5). If corners and C move
// linearly, det and N are cubic in time (Eq. 7 and 8): Σ B₍m₎(t)·D₍m₎ and Σ B₍m₎(t)·N₍m₎. The B₍m₎ are the Bernstein
// polynomials of degree 3, which are ≥ 0 and sum to 1. So the largest of D₍m₎ + r·√(N₍m₎x² + (k·N₍m₎y)²) bounds the
// determinant at all times. The bound is exact for static triangles.

#include <array>
#include <glm/vec3.hpp>

namespace defocus::engine {

struct LensTriangle {
    std::array<glm::dvec3, 3> places;  // (x, y, w) in the clip space of the pinhole camera
    std::array<double, 3> coc{};       // circle of confusion C at each corner
};

// Returns the largest determinant of the triangle's three corners (x, y, w), as seen from any lens point in the disk of
// `radius`. The triangle faces away from all these lens points if the result is ≤ 0.
double largestDeterminant(const LensTriangle& triangle, double aspect, double radius = 1);

// Returns an upper bound of the triangle's determinant, as seen from any lens point in the disk of `radius`, at all
// times while the triangle moves linearly from `from` to `to`.
double largestDeterminant(const LensTriangle& from, const LensTriangle& to, double aspect, double radius = 1);

// Returns the triangle interpolated linearly between `from` (share 0) and `to` (share 1).
LensTriangle between(const LensTriangle& from, const LensTriangle& to, double share);

}  // namespace defocus::engine
