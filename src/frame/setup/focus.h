#pragma once
// Focuses a lens: at a distance, on a node, on the surface at a pixel, on the middle of the image, along a plane
// through three pixels, or along a curved surface near more pixels.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "frame/request.h"
#include "plan/view.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets the focus distance of `view`'s lens. Three points also set its tilt and swing, more points its field curvature
// too. All other members of `view` must be set. The first of these that exists is used: the request's focus, the
// camera's own distance, the median depth of the surfaces in the image's middle, the depth of the scene's centre.
// Throws Error if a pixel shows no surface, if a node lies behind the camera, and for points that focusThrough refuses.
void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view);

// Sets the focus distance, tilt and swing so that the focus plane goes through three points in view space (m; the
// camera looks along −z). Four or more points also set the field curvature, so that the sum of their squared blurs is
// minimal. Each direction n has a focus distance s(n), and a point at depth w has the blur A·|1/s(n) − 1/w| up to a
// factor. 1/s(n) = (1 + κ·r² + t·n)/s is linear in 1/s, κ/s and t/s. Lee, Eisemann and Seidel 2010 (Real-Time Lens Blur
// Effects and Focus Control) also fit a focus to points that the user marks. If the points leave a choice, tilt and
// curvature are minimal. Throws Error for three points on a line, and for a focus that would meet the view axis behind
// the camera. The message begins with `what`, and the lens stays unchanged.
void focusThrough(std::span<const glm::dvec3> points, Lens& lens, const std::string& what);

}  // namespace defocus::engine
