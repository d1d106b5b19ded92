#pragma once
// When a frame is taken: which animation plays, the moment, and what moves while the shutter is open.

#include "app/scene_options.h"
#include "plan/view.h"

namespace defocus {

// The scene in the middle of the exposure. Throws Error for an animation that the scene doesn't have.
Pose exposedPose(const SceneOptions& options, const Scene& scene);

// Fills world.shutter and view.shutterCameras from the options' shutter, for `camera` of that scene; both stay empty
// when it opens and closes at one moment, or the scene has no animation; the cameras where
// theirs stands still. `view.lens` and `settings` are the frame's:
// with exact motion they say when its samples are taken.
void openShutter(const SceneOptions& options, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                 View& view);

}  // namespace defocus
