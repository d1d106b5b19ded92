#pragma once
// Camera movements over which levels of detail change: what popping is measured along.

#include <vector>

#include "plan/view.h"

namespace defocus {

enum class Movement {
    focusPull,  // the focus goes from the nearest to the farthest object, evenly in 1/distance, as a focus ring does
    dolly,      // the camera goes forward along its axis by half the focus distance; the focus stays on its plane
    turntable,  // the camera goes once around the middle of the scene, about the vertical
};

const char* movementName(Movement movement);  // as the command line has it

// The whole movement in `frames` views; `view` lies in the middle of the dolly and of the turntable. Throws Error for
// less than two frames and where nothing lies in front of the camera.
std::vector<View> viewsAlong(Movement movement, const World& world, const View& view, int frames);

// The stretch of `frames` views, the first of several, over which the whole levels nearest to the objects' λ change
// most often: where LodMode::nearest pops. Throws Error for more frames than there are.
std::vector<View> busiestStretch(const std::vector<View>& views, const World& world, const RenderSettings& settings,
                                 int frames);

}  // namespace defocus
