#pragma once
// Settings that a request gives and that change nothing beside the rest of it.

#include <string>
#include <vector>

#include "frame/request.h"
#include "lens/lens.h"
#include "scene/scene.h"

namespace defocus::engine {

// A line for each reason: which options do nothing, and why. `lens` is the one that the request and the camera make.
std::vector<std::string> unusedSettings(const Request& request, const Scene& scene, const Lens& lens);

}  // namespace defocus::engine
