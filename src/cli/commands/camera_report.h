#pragma once
// What photographers ask of a camera, as `defocus info --camera` prints it: field of view, depth of field, exposure,
// and the blur at chosen depths.

#include <optional>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct CameraQuestion {
    std::optional<double> acceptableCoc;  // mm on the sensor; none: the customary one
    std::vector<double> depths;           // m, > 0, infinity is allowed; empty: some around the focus
};

// Depths parted by commas, `inf` among them. Throws Error for what isn't one.
std::vector<double> parseDepths(const std::string& text);

std::string cameraTable(const PreparedFrame& frame, const CameraQuestion& question);

// An infinite distance is null.
std::string cameraJson(const PreparedFrame& frame, const CameraQuestion& question);

}  // namespace defocus::engine
