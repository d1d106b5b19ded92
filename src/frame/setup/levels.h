#pragma once
// Chooses whether a still image is drawn with levels of detail or at full detail.

#include "frame/request.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Draws the frame at full detail (LodMode::off) if the request leaves open both the levels of detail and the number of
// lens samples, and building the levels would take longer than they can save. Call it before addPyramids(). The choice
// depends only on the scene and the view, not on the cache or on the speed of the machine, so it is reproducible.
void chooseLevels(PreparedFrame& frame, const Request& request);

}  // namespace defocus::engine
