#pragma once
// The focal length and the sensor of a file's camera, which says its field of view.
//
// glTF gives a camera's vertical field of view; the image's aspect k gives the horizontal one, tan(θx/2) =
// k·tan(yfov/2). That is what the image shows, whatever else the file says. What is left to choose is the scale of the
// camera:
//   - a file with the draft EXT_camera_physical knows the focal length f; of its sensor, the image takes the width
//     2·f·tan(θx/2): all of it where the camera's field of view fits its sensor's width, else the part that is shown;
//   - otherwise the sensor's width is horizontalAperture, and f = horizontalAperture / (2 tan(θx/2)).
// A focal length that is set by name changes the field of view instead.

#include <functional>
#include <string_view>

#include "lens/lens.h"
#include "scene/camera.h"

namespace defocus::engine {

// Sets of `lens` what follows from the camera: focal length and horizontal aperture, as far as `isSet` doesn't say that
// the field of that name (lens/lens_fields.h) has been set. `aspect` is the image's width over its height.
void fitToCamera(Lens& lens, const Camera& camera, double aspect, const std::function<bool(std::string_view)>& isSet);

}  // namespace defocus::engine
