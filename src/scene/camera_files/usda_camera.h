#pragma once
// Reads cameras from a USD layer. Sources: USD documentation of UsdGeomCamera (units, exposure), UsdGeomXformable
// (order of operations) and UsdStage (interpolation of time samples).
//
// Time code c corresponds to c / timeCodesPerSecond seconds of the animation. The layer's unit and up axis are
// converted. Attributes "custom double defocus:NAME" of the camera are lens values; lens/lens_fields.h lists the names.

#include <string>

#include "scene/camera_files/usda_layer.h"
#include "scene/camera_track.h"

namespace defocus::engine {

// Returns the camera at `path`, such as /World/cam; with an empty path, the layer's only camera. `file` is the name in
// messages. Throws Error if there is no such camera, if it isn't perspective, or if a value is invalid.
CameraTrack usdCamera(UsdLayer layer, const std::string& path, const std::string& file);

}  // namespace defocus::engine
