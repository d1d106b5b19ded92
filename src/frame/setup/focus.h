#pragma once
// Focuses a lens: at a distance, on a node, on the surface at a pixel, at the image's centre, on a plane through three
// pixels, or on a curved surface near more pixels.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "frame/request.h"
#include "plan/view.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets the focus distance of `view`'s lens. A focus on three points also sets tilt and swing; more points also set the
// field curvature. All other members of `view` must be set. Uses the first that exists of: the request's focus, the
// camera's own distance, the median depth of the surfaces near the image's centre, the depth of the scene's centre.
// Throws Error if a pixel shows no surface, if a node lies behind the camera, and in the same cases as focusThrough.
void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view);

// Sets focus distance, tilt and swing so that the plane of focus contains three points in view space (m; the camera
// looks along −z). Four or more points also set the field curvature and minimise the sum of squared blurs. A direction
// n has the focus distance s(n); a point at depth w has a blur proportional to |1/s(n) − 1/w|. With field curvature κ
// and tilt t, 1/s(n) = (1 + κ·r² + t·n)/s is linear in 1/s, κ/s and t/s. Lee, Eisemann and Seidel 2010 (Real-Time Lens
// Blur Effects and Focus Control) also fit the focus to points that the user marks. If the points leave tilt or
// curvature undetermined, these are minimal. Throws Error for collinear points, and if the surface of focus would meet
// the view axis behind the camera. The message begins with `what`; the lens stays unchanged.
void focusThrough(std::span<const glm::dvec3> points, Lens& lens, const std::string& what);

}  // namespace defocus::engine
