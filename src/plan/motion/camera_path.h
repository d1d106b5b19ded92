#pragma once
// The movements that shots and benches share: the camera moves along its view axis or around a point, and the focus
// moves between two distances.

#include "plan/view.h"

namespace defocus::engine {

// Returns the worldFromCamera of an upright camera at `position` that looks at `target`. If the camera looks straight
// up or down, the top of the image points to −z or +z. Throws Error if both are the same point.
glm::dmat4 lookingAt(const glm::dvec3& position, const glm::dvec3& target);

// Moves the camera `forward` metres along its view axis. The lens doesn't change.
View dollied(const View& view, double forward);

// Turns the camera around `centre` by `angle` radians about the vertical (world +y), counter-clockwise as seen from
// above.
View carriedAround(const View& view, const glm::dvec3& centre, double angle);

// Returns the focus distance (m) at `place` ∈ [0, 1] of the way between two distances. It is linear in 1/distance, as a
// focus ring is. Either distance may be infinite.
double focusBetween(double from, double to, double place);

}  // namespace defocus::engine
