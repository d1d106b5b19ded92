#include "lens/camera_lens.h"

#include <cmath>

namespace defocus::engine {

void fitToCamera(Lens& lens, const Camera& camera, double aspect, const std::function<bool(std::string_view)>& isSet) {
    const bool widthIsSet = isSet("horizontalAperture");
    if (camera.physical && !widthIsSet) lens.horizontalAperture = camera.physical->sensorSize.x;
    if (isSet("focalLength")) return;
    const double tanHalfHorizontal = aspect * std::tan(camera.yfov / 2);
    if (camera.physical && !widthIsSet) {
        lens.focalLength = camera.physical->focalLength;
        lens.horizontalAperture = 2 * lens.focalLength * tanHalfHorizontal;
    } else {
        lens.focalLength = focalLengthFromFov(tanHalfHorizontal, lens.horizontalAperture);
    }
}

}  // namespace defocus::engine
