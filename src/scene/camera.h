#pragma once
// Camera as stored in a file. Lens values that the file omits stay empty; the lens then uses its defaults.

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Lens and sensor of a camera from the draft glTF extension EXT_camera_physical. The field of view remains
// Camera::yfov.
struct PhysicalCamera {
    double focalLength = 0;    // mm, > 0
    glm::dvec2 sensorSize{0};  // mm, width and height, > 0
};

struct Camera {
    std::string name;
    double yfov = 0.6911112;            // radians, full vertical angle
    std::optional<double> aspectRatio;  // width / height for which yfov was authored
    double znear = 0.01;                // m
    // Numeric extras of the camera by name, such as "fStop" and "focusDistance"; booleans are 0 and 1.
    // lens/lens_fields.h lists the names that the lens reads.
    std::map<std::string, double, std::less<>> lens;
    std::optional<PhysicalCamera> physical;
    std::string apertureImage;                // image path from extras, relative to the scene file; empty: none
    std::optional<std::string> orthographic;  // reason for rejecting an orthographic camera

    [[nodiscard]] std::optional<double> lensValue(std::string_view lensName) const {
        const auto found = lens.find(lensName);
        return found == lens.end() ? std::nullopt : std::optional(found->second);
    }
};

}  // namespace defocus::engine
