#pragma once
// Focuses a lens: at a distance, on a node, on what a pixel shows, on the middle of the image, along a plane through
// three pixels, or along a curved surface near more of them.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "frame/request.h"
#include "plan/view.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets the focus distance of `view`'s lens, for three points its tilt and swing too, and for more its field curvature.
// Everything else of the view must be set. It takes the first of these that there is: what the request asks for, the
// camera's own distance, the median depth of what the image's middle shows, the depth of the scene's centre. Throws
// Error if a pixel shows nothing, if a node lies behind the camera, and for points that focusThrough refuses.
void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view);

// Sets the focus distance, tilt and swing so that the focus plane goes through three points in view space (m; the
// camera looks along −z). Of four or more, sets the field curvature too, so that the sum of the squares of their blurs
// is least: each pixel has a focus distance s(n) of its own, and the blur of a point at depth w is A·|1/s(n) − 1/w| up
// to a factor, in which 1/s(n) = (1 + κ·r² + t·n)/s is linear (Lee, Eisemann and Seidel 2010, Real-Time Lens Blur
// Effects and Focus Control, fit a focus to what the user marks). Of what the points leave open, the least tilt and
// curvature are taken. Throws Error, which begins with `what`, and leaves the lens as it is for three points on a line,
// and where the focus would meet the view axis behind the camera.
void focusThrough(std::span<const glm::dvec3> points, Lens& lens, const std::string& what);

}  // namespace defocus::engine
