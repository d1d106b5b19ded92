#pragma once
// The state of a scene, its lights and its camera for one frame: all that changes between frames of a film.

#include <vector>

#include "frame/request.h"
#include "frame/setup/prepared_frame.h"
#include "plan/view.h"

namespace defocus::engine {

struct FrameMoment {
    int frame = 0;    // number in its film
    double time = 0;  // s into the animation clip
    Pose pose;        // in the middle of the exposure
    Shutter shutter;
    std::vector<PlacedLight> lights;
    View view;
    RenderSettings settings;
};

// Returns the moment that a prepared frame shows.
FrameMoment momentOf(const PreparedFrame& frame, const Request& request);

// Moves the world to the moment.
void applyMoment(const FrameMoment& moment, World& world);

}  // namespace defocus::engine
