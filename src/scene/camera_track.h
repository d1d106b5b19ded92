#pragma once
// Defines a camera that comes from a separate file instead of the scene file, as a function of time.

#include <functional>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.h"

namespace defocus::engine {

struct TrackedCamera {
    Camera camera;                    // camera with lengths in m
    glm::dmat4 worldFromCamera{1.0};  // transform in m, y up; the camera looks along its −z axis
    // true: the image shows the complete sensor of Camera::physical, and more along one side if the aspect ratios
    // differ (USD's conform policy "expandAperture"). false: Camera::yfov applies.
    bool showsSensor = false;
};

// Times at which the shutter opens and closes, in s relative to the frame's time.
struct ShutterInterval {
    double open = 0;
    double close = 0;
    bool operator==(const ShutterInterval&) const = default;
};

struct CameraTrack {
    std::string source;                               // file and camera name, as the user gave them
    std::function<TrackedCamera(double seconds)> at;  // state of the camera at a time of the animation
    bool moves = false;                               // false: the camera is the same at all times
    std::optional<ShutterInterval> shutter;           // exposure interval of the camera; nullopt: the file has none
    std::vector<std::string> warnings;                // properties of the file that have no effect, one line each
};

}  // namespace defocus::engine
