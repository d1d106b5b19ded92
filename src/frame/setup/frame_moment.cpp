#include "frame/setup/frame_moment.h"

namespace defocus::engine {

FrameMoment momentOf(const PreparedFrame& frame, const Request& request) {
    FrameMoment moment;
    moment.time = request.time;
    moment.pose = frame.world.pose;
    moment.shutter = frame.world.shutter;
    moment.lights = frame.world.lights;
    moment.view = frame.view;
    moment.settings = frame.settings;
    return moment;
}

void applyMoment(const FrameMoment& moment, World& world) {
    world.pose = moment.pose;
    world.shutter = moment.shutter;
    world.lights = moment.lights;
}

}  // namespace defocus::engine
