#pragma once
// Computes the exposure of a frame: its duration, and the scene's poses at the shutter times, the times at which motion
// is sampled.

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "plan/view.h"

namespace defocus::engine {

// Settings for the duration of the exposure and for the sampling of motion.
struct ShutterSettings {
    double seconds = 0;  // duration of the exposure in s; 0: no motion blur
    ShutterPosition position = ShutterPosition::centre;
    MotionSegments motionSegments = 1u;
    std::optional<double> opening;  // opening time in s, relative to the frame's time; replaces `position`

    [[nodiscard]] bool exactMotion() const { return std::holds_alternative<ExactMotion>(motionSegments); }
};

// Returns the middle of the exposure, in seconds relative to the frame's time.
double shutterMiddle(const ShutterSettings& shutter);

// A scene and its camera at one instant.
struct ShutterMoment {
    Pose pose;
    glm::dmat4 worldFromCamera{1.0};
};

// Fills `opened` (World::shutter) and view.shutterCameras with the results of `momentAt`, whose argument is a time in
// seconds relative to the frame's time. Both stay empty if the exposure has no duration. view.shutterCameras also stays
// empty if the camera doesn't move. With ExactMotion, the shutter times are the times of the lens samples, which follow
// from `view` and `settings`.
void openShutter(const ShutterSettings& shutter, const RenderSettings& settings,
                 const std::function<ShutterMoment(double)>& momentAt, Shutter& opened, View& view);

}  // namespace defocus::engine
