#pragma once
// How bright PNG, JPEG and video are made of linear radiance.

#include <variant>

namespace defocus {

// From the lens's exposure time if it has one; otherwise metered if the scene has lights of its own; otherwise 0 EV.
struct DefaultExposure {
    bool operator==(const DefaultExposure&) const = default;
};

struct ExposureValue {
    double ev = 0;  // −60 … 60; each step doubles the brightness
    bool operator==(const ExposureValue&) const = default;
};

// Metered from the scene, once for all frames of a film.
struct MeteredExposure {
    bool operator==(const MeteredExposure&) const = default;
};

using Exposure = std::variant<DefaultExposure, ExposureValue, MeteredExposure>;

}  // namespace defocus
