#pragma once
// A camera as a file gives it. Lens values that a file doesn't give stay empty and fall back to the lens's defaults.

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// The draft extension EXT_camera_physical: the lens and sensor of a camera, whose field of view stays that of the file.
struct PhysicalCamera {
    double focalLength = 0;    // mm, > 0
    glm::dvec2 sensorSize{0};  // mm, width and height, > 0
};

struct Camera {
    std::string name;
    double yfov = 0.6911112;            // radians, full vertical angle
    std::optional<double> aspectRatio;  // width / height that yfov was chosen for
    double znear = 0.01;                // m
    // Numbers of the camera's extras by their names ("fStop", "focusDistance" …; lens/lens_fields.h knows which count);
    // truth values are 0 and 1.
    std::map<std::string, double, std::less<>> lens;
    std::optional<PhysicalCamera> physical;
    std::string apertureImage;                // of the extras: a file's path, relative to the scene's; empty: none
    std::optional<std::string> orthographic;  // set to why the camera can't be used (orthographic cameras)

    [[nodiscard]] std::optional<double> lensValue(std::string_view lensName) const {
        const auto found = lens.find(lensName);
        return found == lens.end() ? std::nullopt : std::optional(found->second);
    }
};

}  // namespace defocus::engine
