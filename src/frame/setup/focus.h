#pragma once
// Focuses a lens: at a distance, on a node, on the surface at a pixel, at the image's centre, on a plane through three
// pixels, or on a curved surface fitted to more pixels.

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "frame/request.h"
#include "plan/view.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets the focus distance of `view`'s lens. A focus on three points also sets tilt and swing; more points also set the
// field curvature. All other members of `view` must be set. If the request sets no focus, uses the camera's own focus
// distance. If the camera has none, uses the median depth of the surfaces near the image's centre, else the depth of
// the scene's centre. Throws Error if a requested pixel shows no surface, if the requested node lies behind the camera,
// and if focusThrough rejects the requested points.
void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view);

// Sets focus distance, tilt and swing so that the plane of focus contains three points in view space (m; the camera
// looks along −z). For four or more points, also sets the field curvature and minimizes the sum of squared blur
// diameters. Where the focus distance is f, a point at depth w has a blur proportional to |1/f − 1/w|. At image
// position p with |p| = r, 1/f = (1 + κ·r² + t·p)/s for the focus distance s on the axis, field curvature κ and tilt t.
// This is linear in 1/s, κ/s and t/s. Lee, Eisemann and Seidel 2010 (Real-Time Lens Blur Effects and Focus Control)
// also fit the focus to points that the user marks. If the points do not determine tilt or curvature, the smallest
// values that fit are used. Throws Error for collinear points, and if the surface of focus would meet the view axis
// behind the camera. The message begins with `what`; the lens stays unchanged.
void focusThrough(std::span<const glm::dvec3> points, Lens& lens, const std::string& what);

}  // namespace defocus::engine
