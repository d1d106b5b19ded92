#pragma once
// Computes the built-in environment maps. Each map is scaled to an illuminance of π lux on an upward-facing horizontal
// surface, so that a white diffuse surface with this orientation has radiance 1.

#include <span>
#include <string>
#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// Returns the names of the built-in maps: "studio" (softboxes in a dark room), "overcast" (CIE overcast sky), "sunset"
// (low sun).
std::span<const std::string_view> builtInEnvironments();
bool isBuiltInEnvironment(const std::string& name);

// Returns a built-in environment map by its name: equirectangular (EnvironmentType::map), 512 x 256 px, linear Rec.709.
// For a camera that faces a model's front (+z), the key light and the sun are on the left.
Image builtInEnvironment(const std::string& name);

// Returns an environment map rotated by `angle` radians about +y, counter-clockwise as seen from above.
Image turnedEnvironment(const Image& map, double angle);

}  // namespace defocus::engine
