#pragma once
// Computes movements for shots and benchmarks: camera dolly, camera orbit, and focus pull.

#include "plan/view.h"

namespace defocus::engine {

// Returns the transform worldFromCamera of an upright camera at `position` that looks at `target`. If the camera looks
// straight down, the top of the image points to −z; if straight up, to +z. Throws Error if both points coincide.
glm::dmat4 lookingAt(const glm::dvec3& position, const glm::dvec3& target);

// Returns the view with the camera moved `forward` metres along its view axis. The lens doesn't change.
View dollied(const View& view, double forward);

// Returns the view with the camera rotated around `centre` by `angle` radians about the vertical axis (world +y). The
// rotation is counter-clockwise as seen from above.
View carriedAround(const View& view, const glm::dvec3& centre, double angle);

// Returns the focus distance (m) at the fraction `place` ∈ [0, 1] of the way between two distances. The interpolation
// is linear in 1/distance, as on a focus ring. Either distance may be infinite.
double focusBetween(double from, double to, double place);

}  // namespace defocus::engine
