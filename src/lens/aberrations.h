#pragma once
// Seidel astigmatism and coma: aberrations that vary over the lens. They are an example of a C that depends on (u, v),
// which Munkberg, Toth and Akenine-Möller 2012 leave to future work.
//
// The image position is m = (n.x, n.y/k), with |m| = 1 at the left and right edges. A ray through the lens point l =
// (u, v) of the unit disk misses the ideal image point. The offset is the gradient of the wavefront error over l
// (Welford 1986, Aberrations of Optical Systems, chapters 7 and 8):
//   W(l) = ½·A·(m·l)² + B·|l|²·(m·l),
//   ∇W   = A·(m·l)·m + B·(2·(m·l)·l + |l|²·m),
// in halves of the image's width. Astigmatism turns a point in focus into a line of length A·|m|² that points to the
// image's centre. Coma turns it into a comet: each circle on the lens maps to a circle that is traversed twice. The
// largest offset of a ray through the lens's rim is 3·B·|m|. The blur offset C·l is added. A and B are fractions of the
// image's width.

#include <glm/vec2.hpp>

#include "lens/circle_of_confusion.h"

namespace defocus::engine {

// Returns B for a coma whose tail has the given length at the left and right edges, as a fraction of the image's width.
double comaOfTail(double length);

// Returns ∇W at the image position `ndc`, in halves of the image's width, for a lens point in the unit disk.
glm::dvec2 aberration(const ClipCircleOfConfusion& coc, const glm::dvec2& ndc, const glm::dvec2& lensPoint);

// Returns the diameter of the disk around an image point that contains ∇W for all lens points. The result is a fraction
// of the image's width and holds for positions up to |m| = `radius`.
double aberrationReach(const ClipCircleOfConfusion& coc, double radius);

}  // namespace defocus::engine
