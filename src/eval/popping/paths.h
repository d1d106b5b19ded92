#pragma once
// Computes movements of focus, camera and scene that change levels of detail, for the popping benchmark.

#include <vector>

#include "plan/view.h"

namespace defocus::engine {

enum class Movement {
    focusPull,  // the focus moves from the nearest to the farthest object, evenly in 1/distance, like a focus ring
    dolly,      // the camera moves forward by half the focus distance; the plane of focus stays fixed in the scene
    turntable,  // the camera circles the scene's centre once, about the vertical axis
    clip,       // an animation of the scene, such as a walk cycle, plays once; the camera is fixed
};

const char* movementName(Movement movement);  // returns the name on the command line

struct MovementFrame {
    View view;
    Pose pose;
};

// Returns the complete movement, divided into `frames` frames. `view`: view at half the time of the dolly and of the
// turntable. The pose is that of `world`, except with Movement::clip, which plays the scene's clip with index `clip`.
// Throws Error for fewer than two frames, if no object is in front of the camera, or if the scene doesn't have the
// clip.
std::vector<MovementFrame> framesAlong(Movement movement, const World& world, const View& view, int frames,
                                       int clip = 0);

// Copies the frame's pose and lights to the world.
void poseWorld(World& world, const MovementFrame& frame);

// Returns the `length` consecutive frames with the most level changes under LodMode::nearest; if several sequences tie,
// the first. Leaves `world` in the pose of the last frame. Throws Error if `length` exceeds the number of frames.
std::vector<MovementFrame> busiestStretch(const std::vector<MovementFrame>& frames, World& world,
                                          const RenderSettings& settings, int length);

}  // namespace defocus::engine
