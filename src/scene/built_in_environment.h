#pragma once
// Surroundings that need no file: high-dynamic-range maps that are computed. Each throws an illuminance of
// π lux on a level surface, so that a matt white one has a radiance of 1.

#include <span>
#include <string>
#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// "studio" (softboxes in a dark room), "overcast" (the CIE's overcast sky), "sunset" (a low sun)
std::span<const std::string_view> builtInEnvironments();
bool isBuiltInEnvironment(const std::string& name);

// The equirectangular map of that name (EnvironmentType::map), 512 x 256 px of linear Rec.709. The light of the studio
// and the sun come from the left of a camera that looks at the front of a model, which faces +z.
Image builtInEnvironment(const std::string& name);

// The map turned counter-clockwise, seen from above, by an angle in radians.
Image turnedEnvironment(const Image& map, double angle);

}  // namespace defocus::engine
