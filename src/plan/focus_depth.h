#pragma once
// Where to focus: how far along the view axis (m) a node, what a pixel shows, or what the image's middle shows lies at
// one moment. All of the view but its focus distance must be set. `who` opens the messages: "--focus-pixel", "focus".

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "plan/view.h"

namespace defocus {

// The depth of the node's centre. Throws Error for a name that isn't there and for a node behind the camera.
double depthOfNode(const Scene& scene, const Pose& pose, const View& view, std::string_view name, const char* who);

// The first surfaces behind places of the image (px from its top left corner), in view space, for the field of view
// that `lens` has; nothing where there is none.
std::vector<std::optional<glm::dvec3>> surfacesAt(const Scene& scene, const Pose& pose, const View& view,
                                                  const Lens& lens, const std::vector<glm::dvec2>& places);

// What a pixel shows through `lens`. Throws Error for a pixel outside the image and for one that shows nothing.
glm::dvec3 surfaceAtPixel(const Scene& scene, const Pose& pose, const View& view, const Lens& lens,
                          const glm::ivec2& pixel, const char* who);

// The depth of what a pixel (column from the left, row from the top) shows. Throws as surfaceAtPixel.
double depthAtPixel(const Scene& scene, const Pose& pose, const View& view, const glm::ivec2& pixel, const char* who);

// The median depth of what the image's central third shows. Throws Error where that is nothing.
double depthOfMiddle(const Scene& scene, const Pose& pose, const View& view, const char* who);

}  // namespace defocus
