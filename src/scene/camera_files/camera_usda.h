#pragma once
// Writes a camera as USD text (.usda).

#include <string>

#include "scene/camera_files/camera_take.h"

namespace defocus::engine {

// Returns a USD layer with the camera /World/NAME. Characters that are not allowed in USD names are replaced by
// underscores. The layer's unit is 1 m. If `take` has several samples, they become time samples. Lens values without a
// USD attribute are written as "custom double defocus:NAME".
std::string cameraUsdaText(const CameraTake& take);

}  // namespace defocus::engine
