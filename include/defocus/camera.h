#pragma once
// Ways to select the camera that renders an image.

#include <array>
#include <string>
#include <variant>

namespace defocus {

using Vector3 = std::array<double, 3>;

// Selects the first camera of the scene file. If the file has no camera, selects a camera that frames the scene.
struct FirstCamera {
    bool operator==(const FirstCamera&) const = default;
};

// Selects the camera with this name in the scene file.
struct NamedCamera {
    std::string name;
    bool operator==(const NamedCamera&) const = default;
};

// Selects a camera that frames the scene, even if the scene file has cameras.
struct FramingCamera {
    bool operator==(const FramingCamera&) const = default;
};

using CameraChoice = std::variant<FirstCamera, NamedCamera, FramingCamera>;

}  // namespace defocus
