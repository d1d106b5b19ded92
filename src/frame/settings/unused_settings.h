#pragma once
// Finds settings that a request gives but that have no effect.

#include <string>
#include <vector>

#include "frame/request.h"
#include "lens/lens.h"
#include "scene/scene.h"

namespace defocus::engine {

// Returns a line for each reason that lists the options without effect. `lens`: the lens of the request and its camera.
std::vector<std::string> unusedSettings(const Request& request, const Scene& scene, const Lens& lens);

}  // namespace defocus::engine
