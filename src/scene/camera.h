#pragma once
// Camera as stored in a file. Lens values that the file omits are empty; src/lens replaces them with defaults.

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Lens and sensor of a camera from the draft glTF extension EXT_camera_physical. They do not change the field of view,
// Camera::yfov.
struct PhysicalCamera {
    double focalLength = 0;    // focal length in mm, > 0
    glm::dvec2 sensorSize{0};  // width and height in mm, > 0
};

struct Camera {
    std::string name;
    double yfov = 0.6911112;            // full vertical field of view, radians
    std::optional<double> aspectRatio;  // width / height of the image for which yfov was chosen
    double znear = 0.01;                // depth of the near plane, m
    // Numeric extras of the camera by name, such as "fStop" and "focusDistance"; booleans are 0 or 1.
    // lens/lens_fields.h lists the names that have an effect.
    std::map<std::string, double, std::less<>> lens;
    std::optional<PhysicalCamera> physical;
    std::string apertureImage;                // image path from the extras, relative to the scene file; empty: none
    std::optional<std::string> orthographic;  // why an orthographic camera is rejected; nullopt: perspective

    [[nodiscard]] std::optional<double> lensValue(std::string_view lensName) const {
        const auto found = lens.find(lensName);
        return found == lens.end() ? std::nullopt : std::optional(found->second);
    }
};

}  // namespace defocus::engine
