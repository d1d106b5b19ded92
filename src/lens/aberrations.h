#pragma once
// Seidel's astigmatism and coma: aberrations that differ from point to point of the lens. They are an example of a C
// that depends on (u, v), which Munkberg, Toth and Akenine-Möller 2012 leave to future work.
//
// A ray from the lens point l = (u, v) of the unit disk misses the image of its place m = (n.x, n.y/k), which is 1 at
// the image's left and right edges, by the gradient over l of the wavefront's error (Welford 1986, Aberrations of
// Optical Systems, chapters 7 and 8)
//   W(l) = ½·A·(m·l)² + B·|l|²·(m·l),
//   ∇W   = A·(m·l)·m + B·(2·(m·l)·l + |l|²·m),
// in halves of the image's width. So a place in focus becomes a line of length A·|m|² that points to the image's
// centre, or a comet: the rays of each circle on the lens make a circle of twice the angle, and the farthest ray of the
// lens's rim misses by 3·B·|m|. Blur adds its C·l to that. A and B are shares of the image's width.

#include <glm/vec2.hpp>

#include "lens/circle_of_confusion.h"

namespace defocus::engine {

// B of a comet whose tail is `length` long at the image's left and right edges, a share of the image's width.
double comaOfTail(double length);

// Returns ∇W at the place `ndc`, in halves of the image's width, for a lens point in the unit disk.
glm::dvec2 aberration(const ClipCircleOfConfusion& coc, const glm::dvec2& ndc, const glm::dvec2& lensPoint);

// Returns the diameter of the disk around a place that holds ∇W of all lens points, as a share of the image's width,
// for places up to |m| = `radius`.
double aberrationReach(const ClipCircleOfConfusion& coc, double radius);

}  // namespace defocus::engine
