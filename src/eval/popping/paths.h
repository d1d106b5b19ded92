#pragma once
// Movements of camera and scene over which levels of detail change: what popping is measured along.

#include <vector>

#include "plan/view.h"

namespace defocus {

enum class Movement {
    focusPull,  // the focus goes from the nearest to the farthest object, evenly in 1/distance, as a focus ring does
    dolly,      // the camera goes forward along its axis by half the focus distance; the focus stays on its plane
    turntable,  // the camera goes once around the middle of the scene, about the vertical
    clip,       // an animation of the scene plays once, such as a walk cycle; the camera stands still
};

const char* movementName(Movement movement);  // as the command line has it

struct MovementFrame {
    View view;
    Pose pose;
};

// The whole movement in `frames` frames; `view` lies in the middle of the dolly and of the turntable, and the pose is
// the world's but for Movement::clip, which plays the scene's clip number `clip`. Throws Error for less than two
// frames, where nothing lies in front of the camera, and for a clip that the scene doesn't have.
std::vector<MovementFrame> framesAlong(Movement movement, const World& world, const View& view, int frames,
                                       int clip = 0);

// Puts the world into the frame's pose.
void poseWorld(World& world, const MovementFrame& frame);

// The stretch of `length` frames, the first of several, over which the whole levels nearest to the objects' λ change
// most often: where LodMode::nearest pops. Leaves `world` in the last frame's pose. Throws Error for more frames than
// there are.
std::vector<MovementFrame> busiestStretch(const std::vector<MovementFrame>& frames, World& world,
                                          const RenderSettings& settings, int length);

}  // namespace defocus
