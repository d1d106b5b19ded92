#pragma once
// A camera as a file gives it. Lens values that a file doesn't give stay empty and fall back to the lens's defaults.

#include <optional>
#include <string>

namespace defocus {

struct Camera {
    std::string name;
    double yfov = 0.6911112;            // radians, full vertical angle
    std::optional<double> aspectRatio;  // width / height that yfov was chosen for
    double znear = 0.01;                // m
    std::optional<double> fStop;
    std::optional<double> focusDistance;       // m
    std::optional<double> horizontalAperture;  // mm
    std::optional<std::string> orthographic;   // set to why the camera can't be used (orthographic cameras)
};

}  // namespace defocus
