#pragma once
// Finds settings that a request gives although they have no effect.

#include <string>
#include <vector>

#include "frame/request.h"
#include "lens/lens.h"
#include "scene/scene.h"

namespace defocus::engine {

// Returns a line for each reason, with the options that have no effect for that reason. `lens`: the lens after the
// values of the scene's camera and of the request have been applied.
std::vector<std::string> unusedSettings(const Request& request, const Scene& scene, const Lens& lens);

}  // namespace defocus::engine
