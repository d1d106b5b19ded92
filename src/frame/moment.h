#pragma once
// When a frame is taken: which animation plays, the moment, and what moves while the shutter is open.

#include "frame/request.h"
#include "plan/shutter.h"

namespace defocus {

// The scene in the middle of the exposure. Throws Error for an animation that the scene doesn't have.
Pose exposedPose(const Request& request, const Scene& scene);

// openShutter of plan/shutter.h for the options' animation and for `camera` of the world's scene.
void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view);

}  // namespace defocus
