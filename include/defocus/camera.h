#pragma once
// Choice of the camera that a picture is taken with.

#include <array>
#include <string>
#include <variant>

namespace defocus {

using Vector3 = std::array<double, 3>;

// Selects the file's first camera, or a camera that frames the scene if the file has no camera.
struct FirstCamera {
    bool operator==(const FirstCamera&) const = default;
};

// Selects the camera with this name in the file.
struct NamedCamera {
    std::string name;
    bool operator==(const NamedCamera&) const = default;
};

// Selects a camera that frames the scene; cameras in the file are ignored.
struct FramingCamera {
    bool operator==(const FramingCamera&) const = default;
};

using CameraChoice = std::variant<FirstCamera, NamedCamera, FramingCamera>;

}  // namespace defocus
