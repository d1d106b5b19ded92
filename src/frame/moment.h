#pragma once
// When a frame is taken: which animation plays, the moment, and what moves while the shutter is open.

#include "frame/scene_options.h"

namespace defocus {

// The scene in the middle of the exposure. Throws Error for an animation that the scene doesn't have.
Pose exposedPose(const SceneOptions& options, const Scene& scene);

// openShutter of plan/shutter.h for the options' animation and for `camera` of the world's scene.
void exposeMotion(const SceneOptions& options, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view);

}  // namespace defocus
