#pragma once
// How long the shutter of a frame is open, and which of its moments a plan needs the scene's poses for.

#include <functional>
#include <vector>

#include "plan/view.h"

namespace defocus {

// The middle of the exposure, s from the frame's time.
double shutterMiddle(const ShutterSettings& shutter);

// A scene and its camera at one moment.
struct ShutterMoment {
    Pose pose;
    glm::dmat4 worldFromCamera{1.0};
};

// Fills `opened` (World::shutter) and view.shutterCameras with what `momentAt` gives for times in s from the frame's;
// both stay empty where the shutter opens and closes at one moment, the cameras where theirs stands still. `view` and
// `settings` are the frame's: with exact motion they say when its samples are taken.
void openShutter(const ShutterSettings& shutter, const RenderSettings& settings,
                 const std::function<ShutterMoment(double)>& momentAt, Shutter& opened, View& view);

}  // namespace defocus
