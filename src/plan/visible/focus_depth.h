#pragma once
// Finds depths for automatic focus, in m along the view axis: of a node, of a pixel's surface, or of the middle of the
// image. The view must be complete except for its focus distance. Error messages begin with `who`, such as
// "--focus-pixel" or "focus".

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "plan/view.h"

namespace defocus::engine {

// Returns the depth of the node's centre. Throws Error if the node doesn't exist or lies behind the camera.
double depthOfNode(const Scene& scene, const Pose& pose, const View& view, std::string_view name, const char* who);

// Returns the nearest surface point, in view space, at each image position in `places`; nullopt where no surface is
// visible. Positions are in px from the top left corner. `lens` gives the field of view.
std::vector<std::optional<glm::dvec3>> surfacesAt(const Scene& scene, const Pose& pose, const View& view,
                                                  const Lens& lens, const std::vector<glm::dvec2>& places);

// Returns the surface point that is visible at a pixel through `lens`. Throws Error if the pixel lies outside the image
// or no surface is visible there.
glm::dvec3 surfaceAtPixel(const Scene& scene, const Pose& pose, const View& view, const Lens& lens,
                          const glm::ivec2& pixel, const char* who);

// Returns the depth of the surface that is visible at a pixel (column from the left, row from the top). Throws Error
// like surfaceAtPixel.
double depthAtPixel(const Scene& scene, const Pose& pose, const View& view, const glm::ivec2& pixel, const char* who);

// Returns the median depth of the surfaces in the central third of the image; nullopt if no surface is visible there.
std::optional<double> depthOfMiddle(const Scene& scene, const Pose& pose, const View& view);
// Returns the median depth of the surfaces in the central third of the image. Throws Error if no surface is visible
// there.
double depthOfMiddle(const Scene& scene, const Pose& pose, const View& view, const char* who);

}  // namespace defocus::engine
