#pragma once
// Procedural environment maps that need no file. Each is scaled to an illuminance of π lux on a horizontal surface, so
// that a white diffuse surface there has radiance 1.

#include <span>
#include <string>
#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// Names: "studio" (softboxes in a dark room), "overcast" (CIE overcast sky), "sunset" (low sun).
std::span<const std::string_view> builtInEnvironments();
bool isBuiltInEnvironment(const std::string& name);

// Returns the named equirectangular map (EnvironmentType::map): 512 x 256 px, linear Rec.709. For a camera that looks
// at a model's front (+z), the key softbox and the sun are on the left.
Image builtInEnvironment(const std::string& name);

// Returns the map rotated by `angle` radians, counter-clockwise as seen from above.
Image turnedEnvironment(const Image& map, double angle);

}  // namespace defocus::engine
