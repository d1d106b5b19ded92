#pragma once
// Movements of focus, camera and scene that change levels of detail. The popping benchmark measures along them.

#include <vector>

#include "plan/view.h"

namespace defocus::engine {

enum class Movement {
    focusPull,  // the focus goes from the nearest to the farthest object, evenly in 1/distance, as a focus ring does
    dolly,      // the camera goes forward along its axis by half the focus distance; the focus stays on its plane
    turntable,  // the camera circles the scene's centre once, about the vertical
    clip,       // an animation of the scene plays once, such as a walk cycle; the camera stands still
};

const char* movementName(Movement movement);  // the name on the command line

struct MovementFrame {
    View view;
    Pose pose;
};

// Returns the complete movement as `frames` frames. `view` is in the middle of the dolly and of the turntable. All
// frames have the world's pose, except with Movement::clip, which plays the scene's clip number `clip`. Throws Error if
// there are fewer than two frames, if nothing lies in front of the camera, or if the scene doesn't have the clip.
std::vector<MovementFrame> framesAlong(Movement movement, const World& world, const View& view, int frames,
                                       int clip = 0);

// Sets the world's pose and lights to those of the frame.
void poseWorld(World& world, const MovementFrame& frame);

// Returns the `length` consecutive frames with the most level changes under LodMode::nearest; ties go to the first.
// Leaves `world` in the pose of the last frame. Throws Error if `length` is larger than the number of frames.
std::vector<MovementFrame> busiestStretch(const std::vector<MovementFrame>& frames, World& world,
                                          const RenderSettings& settings, int length);

}  // namespace defocus::engine
