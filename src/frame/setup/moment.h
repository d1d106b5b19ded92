#pragma once
// Chooses a frame's animation, its time, and its exposure interval for motion blur.

#include "frame/request.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// Returns the index of the animation that the request selects. Throws Error if the scene doesn't have that animation.
int clipOf(const Request& request, const Scene& scene);

// Returns the request's shutter; if the request has none, the shutter of the scene's camera track.
ShutterSettings shutterOf(const Request& request, const Scene& scene);

// Returns the scene's pose at the middle of the exposure, without the nodes that the request hides. Throws Error if the
// scene doesn't have the animation that the request names.
Pose exposedPose(const Request& request, const Scene& scene);

// Calls openShutter (plan/motion/shutter.h) for the request's animation and for `camera`, a camera of the world's
// scene.
void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view);

}  // namespace defocus::engine
