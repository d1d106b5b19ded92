#pragma once
// Seidel astigmatism and coma: blur that varies over the lens points l = (u, v). This extends Munkberg, Toth and
// Akenine-Möller 2012, who leave such blur to future work.
//
// The image position is m = (n.x, n.y/k), where n is in normalised device coordinates and k is the aspect ratio. |m| is
// 1 at the left and right edges. A ray through the lens point l of the unit disk misses the ideal image point. The
// offset, in units of half the image's width, is the gradient ∇W of the wavefront error W over l (Welford 1986,
// Aberrations of Optical Systems, chapters 7 and 8):
//   W(l) = ½·A·(m·l)² + B·|l|²·(m·l),
//   ∇W   = A·(m·l)·m + B·(2·(m·l)·l + |l|²·m).
// The coefficients A of astigmatism and B of coma are fractions of the image's width. Astigmatism turns a point in
// focus into a line that points to the image's centre; its length is A·|m|² image widths. Coma turns the point into a
// comet: each circle on the lens maps to a circle that is traversed twice. The largest offset of a ray through the
// lens's rim is 3·B·|m| half widths. Defocus adds the offset c·l, also in half widths, where c is the signed CoC
// diameter as a fraction of the image's width.

#include <glm/vec2.hpp>

#include "lens/circle_of_confusion.h"

namespace defocus::engine {

// Returns the coma coefficient B that gives points at the left and right edges a coma tail of `length`. B and `length`
// are fractions of the image's width.
double comaOfTail(double length);

// Returns the image offset of a ray that astigmatism and coma cause, in units of half the image's width: ∇W, the
// gradient of the wavefront error. `ndc` is the image position, and `lensPoint` lies in the unit disk.
glm::dvec2 aberration(const ClipCircleOfConfusion& coc, const glm::dvec2& ndc, const glm::dvec2& lensPoint);

// Returns the diameter of a disk that contains the offsets (by astigmatism and coma) of the rays through all lens
// points, as a fraction of the image's width. The result is an upper bound for all image positions at most `radius`
// from the image's centre; the radius is 1 at the left and right edges.
double aberrationReach(const ClipCircleOfConfusion& coc, double radius);

}  // namespace defocus::engine
