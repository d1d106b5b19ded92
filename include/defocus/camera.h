#pragma once
// Which camera a picture is taken with.

#include <array>
#include <string>
#include <variant>

namespace defocus {

using Vector3 = std::array<double, 3>;

// The file's first camera; a camera that frames the scene if the file has none.
struct FirstCamera {
    bool operator==(const FirstCamera&) const = default;
};

// The file's camera of this name.
struct NamedCamera {
    std::string name;
    bool operator==(const NamedCamera&) const = default;
};

// A camera that frames the scene, whatever cameras the file has.
struct FramingCamera {
    bool operator==(const FramingCamera&) const = default;
};

using CameraChoice = std::variant<FirstCamera, NamedCamera, FramingCamera>;

}  // namespace defocus
