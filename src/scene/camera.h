#pragma once
// A camera as a file gives it. Lens values that a file doesn't give stay empty and fall back to the lens's defaults.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace defocus {

struct Camera {
    std::string name;
    double yfov = 0.6911112;            // radians, full vertical angle
    std::optional<double> aspectRatio;  // width / height that yfov was chosen for
    double znear = 0.01;                // m
    // Numbers of the camera's extras by their names ("fStop", "focusDistance" …; lens/lens_fields.h knows which count);
    // truth values are 0 and 1.
    std::map<std::string, double, std::less<>> lens;
    std::string apertureImage;  // of the extras: a file's path, relative to the scene's; empty: none
    std::optional<std::string> orthographic;  // set to why the camera can't be used (orthographic cameras)

    [[nodiscard]] std::optional<double> lensValue(std::string_view lensName) const {
        const auto found = lens.find(lensName);
        return found == lens.end() ? std::nullopt : std::optional(found->second);
    }
};

}  // namespace defocus
