#pragma once
// Reports camera data for photographers, for `defocus info --camera`: field of view, depth of field, exposure, and the
// blur at chosen depths.

#include <optional>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct CameraQuestion {
    std::optional<double> acceptableCoc;  // diameter on the sensor, mm; nullopt: sensor diagonal / 1500
    std::vector<double> depths;           // depths in m, > 0, may be infinite; empty: depths around the focus distance
};

// Parses depths (m) separated by commas; "inf" is infinity. Throws Error for any other text.
std::vector<double> parseDepths(const std::string& text);

std::string cameraTable(const PreparedFrame& frame, const CameraQuestion& question);

// Returns the camera data as a JSON object. Infinite distances are null.
std::string cameraJson(const PreparedFrame& frame, const CameraQuestion& question);

}  // namespace defocus::engine
