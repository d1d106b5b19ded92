#pragma once
// Exposure of PNG, JPEG and video: the gain that is applied to linear radiance before tone mapping.

#include <variant>

namespace defocus {

// Exposure from the lens's exposure time and ISO if an exposure time is set. Otherwise, scenes with lights are metered,
// and other scenes have 0 EV.
struct DefaultExposure {
    bool operator==(const DefaultExposure&) const = default;
};

struct ExposureValue {
    double ev = 0;  // exposure in EV, [−60, 60]; adding 1 doubles the brightness
    bool operator==(const ExposureValue&) const = default;
};

// Exposure metered from the image; for a video, once for all frames.
struct MeteredExposure {
    bool operator==(const MeteredExposure&) const = default;
};

using Exposure = std::variant<DefaultExposure, ExposureValue, MeteredExposure>;

}  // namespace defocus
