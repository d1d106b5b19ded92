#pragma once
// Says how long the shutter of a frame is open, and poses the scene at the moments that a plan needs.

#include <functional>
#include <variant>
#include <vector>

#include "plan/view.h"

namespace defocus::engine {

// How long the shutter is open, and how motion is followed meanwhile.
struct ShutterSettings {
    double seconds = 0;  // 0: everything stands still
    ShutterPosition position = ShutterPosition::centre;
    MotionSegments motionSegments = 1u;

    [[nodiscard]] bool exactMotion() const { return std::holds_alternative<ExactMotion>(motionSegments); }
};

// Returns the middle of the exposure, in seconds from the frame's time.
double shutterMiddle(const ShutterSettings& shutter);

// A scene and its camera at one moment.
struct ShutterMoment {
    Pose pose;
    glm::dmat4 worldFromCamera{1.0};
};

// Fills `opened` (World::shutter) and view.shutterCameras with what `momentAt` returns for times in seconds from the
// frame's time. Both stay empty if the shutter opens and closes at one moment; the cameras also stay empty if the
// camera doesn't move. With exact motion, `view` and `settings` of the frame decide when its samples are taken.
void openShutter(const ShutterSettings& shutter, const RenderSettings& settings,
                 const std::function<ShutterMoment(double)>& momentAt, Shutter& opened, View& view);

}  // namespace defocus::engine
