#pragma once
// Exposure of PNG, JPEG and video: the gain that is applied to linear radiance before tone mapping.

#include <variant>

namespace defocus {

// Follows the lens's exposure time if it is set. Otherwise the scene is metered if it has lights, or else 0 EV applies.
struct DefaultExposure {
    bool operator==(const DefaultExposure&) const = default;
};

struct ExposureValue {
    double ev = 0;  // [−60, 60]; each step doubles the brightness
    bool operator==(const ExposureValue&) const = default;
};

// Exposure metered from the scene, once for all frames of a video.
struct MeteredExposure {
    bool operator==(const MeteredExposure&) const = default;
};

using Exposure = std::variant<DefaultExposure, ExposureValue, MeteredExposure>;

}  // namespace defocus
