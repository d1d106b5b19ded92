#pragma once
// Describes the state of the scene, lights and camera in one frame: everything that changes between the frames of a
// shot.

#include <vector>

#include "frame/request.h"
#include "frame/setup/prepared_frame.h"
#include "plan/view.h"

namespace defocus::engine {

struct FrameMoment {
    int frame = 0;    // frame number in the shot
    double time = 0;  // time in the animation clip, s
    Pose pose;        // pose in the middle of the exposure
    Shutter shutter;
    std::vector<PlacedLight> lights;
    View view;
    RenderSettings settings;
};

// Returns the state of a prepared frame at the request's time.
FrameMoment momentOf(const PreparedFrame& frame, const Request& request);

// Copies pose, shutter and lights of `moment` to the world.
void applyMoment(const FrameMoment& moment, World& world);

}  // namespace defocus::engine
