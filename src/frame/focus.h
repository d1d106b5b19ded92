#pragma once
// Focuses a lens: at a distance, on a node, on what a pixel shows, on the middle of the image, or along a plane through
// three pixels.

#include <array>
#include <glm/vec3.hpp>
#include <string>

#include "frame/request.h"
#include "plan/view.h"
#include "scene/camera.h"

namespace defocus {

// Sets the focus distance of `view`'s lens, and for three points its tilt and swing too. Everything else of the view
// must be set. It takes the first of these that there is: what the request asks for, the camera's own distance, the
// median depth of what the image's middle shows, the depth of the scene's centre. Throws Error if a pixel shows
// nothing, if a node lies behind the camera, and for three points on a line or on a plane that meets the view axis
// behind the camera.
void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view);

// Sets the focus distance, tilt and swing so that the focus plane goes through three points in view space (m; the
// camera looks along −z). Throws Error, which begins with `what`, and leaves the lens as it is for three points on a
// line or on a plane that meets the view axis behind the camera.
void focusThrough(const std::array<glm::dvec3, 3>& points, Lens& lens, const std::string& what);

}  // namespace defocus
