#pragma once
// Chooses the animation and the time of a frame, and opens the shutter for motion blur.

#include "frame/request.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// Returns the index of the animation that the request names. Throws Error for an animation that the scene doesn't have.
int clipOf(const Request& request, const Scene& scene);

// Returns the scene's pose in the middle of the exposure, without the nodes that the request hides. Throws Error for an
// animation that the scene doesn't have.
Pose exposedPose(const Request& request, const Scene& scene);

// Calls openShutter (plan/motion/shutter.h) for the request's animation and for `camera`, which belongs to the world's
// scene.
void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view);

}  // namespace defocus::engine
