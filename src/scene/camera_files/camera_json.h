#pragma once
// Reads cameras from JSON that scripts write:
//   {"camera": NAME, "aspectRatio": K, "frameRate": F, "shutter": {"open": S, "close": S},
//    "samples": [{"time": S, "worldFromCamera": [16 numbers, column after column], "nearPlane": M, "lens": {…}}, …]}
// Lengths are in m, but lens values are in the units of lens/lens_fields.h.

#include <string>
#include <string_view>

#include "scene/camera_files/camera_take.h"
#include "scene/camera_track.h"

namespace defocus::engine {

std::string cameraJsonText(const CameraTake& take);

// Returns the camera that a JSON document describes. Between samples, positions and lens values are interpolated
// linearly and rotations spherically. `name`: the name that the camera must have; empty: any name. `file`: file name
// for messages. Throws Error if the document does not describe such a camera.
CameraTrack jsonCamera(std::string_view text, const std::string& name, const std::string& file);

}  // namespace defocus::engine
