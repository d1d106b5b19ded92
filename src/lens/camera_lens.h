#pragma once
// Derives a lens's focal length and sensor width from a camera in a glTF file.
//
// glTF gives a camera's vertical field of view yfov. For the image's aspect ratio k, the horizontal field of view θx
// follows from tan(θx/2) = k·tan(yfov/2). The image always shows this field of view. Only the camera's physical scale
// remains to be chosen:
//   - a file with the draft extension EXT_camera_physical gives the focal length f. The image uses the sensor width
//   2·f·tan(θx/2), which may be less than the sensor's full width;
//   - otherwise the sensor's width is horizontalAperture, and f = horizontalAperture / (2 tan(θx/2)).
// A focal length that the user sets changes the field of view instead.

#include <functional>
#include <string_view>

#include "lens/lens.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets the focal length and the horizontal aperture of `lens` from `camera`, except fields for whose name
// (lens/lens_fields.h) `isSet` returns true. `aspect` is the image's width over its height.
void fitToCamera(Lens& lens, const Camera& camera, double aspect, const std::function<bool(std::string_view)>& isSet);

}  // namespace defocus::engine
