#pragma once
// Decides when a frame is taken: which animation plays, the moment, and what moves while the shutter is open.

#include "frame/request.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// Returns the number of the animation that the request names. Throws Error for one that the scene doesn't have.
int clipOf(const Request& request, const Scene& scene);

// Returns the pose of the scene in the middle of the exposure, without the nodes that the request hides. Throws Error
// for an animation that the scene doesn't have.
Pose exposedPose(const Request& request, const Scene& scene);

// Calls openShutter (plan/shutter.h) for the request's animation and for `camera`, which belongs to the world's scene.
void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view);

}  // namespace defocus::engine
