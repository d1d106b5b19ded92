#pragma once
// Steps of the movements that shots and benches share: along the view axis, around a point, and of the focus.

#include "plan/view.h"

namespace defocus {

// The view from `forward` m further along its own axis; the lens stays as it is.
View dollied(const View& view, double forward);

// The view carried around `centre` by `angle` radians about the vertical (world +y), counter-clockwise from above.
View carriedAround(const View& view, const glm::dvec3& centre, double angle);

// The focus distance (m) at `place` ∈ [0, 1] of the way from one distance to another, evenly in 1/distance as a focus
// ring goes; either may be infinite.
double focusBetween(double from, double to, double place);

}  // namespace defocus
