#pragma once
// Steps of the movements that shots and benches share: along the view axis, around a point, and of the focus.

#include "plan/view.h"

namespace defocus {

// worldFromCamera that looks from `position` to `target`, upright; straight up or down, the image's top lies at −z or
// +z. Throws Error where both are the same point.
glm::dmat4 lookingAt(const glm::dvec3& position, const glm::dvec3& target);

// The view from `forward` m further along its own axis; the lens stays as it is.
View dollied(const View& view, double forward);

// The view carried around `centre` by `angle` radians about the vertical (world +y), counter-clockwise from above.
View carriedAround(const View& view, const glm::dvec3& centre, double angle);

// The focus distance (m) at `place` ∈ [0, 1] of the way from one distance to another, evenly in 1/distance as a focus
// ring goes; either may be infinite.
double focusBetween(double from, double to, double place);

}  // namespace defocus
