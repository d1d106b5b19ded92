#include "frame/setup/scene_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "frame/setup/moment.h"
#include "lens/camera_lens.h"
#include "plan/visible/focus_depth.h"
#include "scene/defaults.h"
#include "scene/units.h"

namespace defocus::engine {

namespace {

bool saysLength(const Request& request) {
    return std::holds_alternative<FocusDistance>(request.focus) || request.lens.focusRangeFront ||
           request.lens.focusRangeBehind || request.cameraPosition || request.cameraTarget;
}

bool physical(const Camera& camera) {
    return camera.physical || camera.lensValue("focusDistance") || camera.lensValue("focalLength");
}

// Returns, in scene units, the longer side of the area that the image shows at the depth of the surfaces near the
// image's centre. For the default camera, which shows the complete scene, returns the longest side of the scene's
// bounding box.
double framedExtent(const Request& request, const Scene& scene, const Pose& pose, const PlacedCamera& placed) {
    if (placed.node < 0) {
        const glm::dvec3 size = pose.bounds.empty() ? glm::dvec3(0) : pose.bounds.size();
        return std::max({size.x, size.y, size.z});
    }
    View view;
    view.worldFromCamera = placed.worldFromCamera;
    view.width = request.size.width;
    view.height = request.size.height;
    fitToCamera(view.lens, placed.camera, static_cast<double>(request.size.width) / request.size.height,
                [](std::string_view) { return false; });
    const double width = 2 * tanHalfHorizontalFov(view.lens) * depthOfMiddle(scene, pose, view).value_or(0);
    return width * std::max(1.0, static_cast<double>(request.size.height) / request.size.width);
}

double guess(const Request& request, Scene& scene) {
    scene.metresPerUnit = 1;
    const Pose pose = exposedPose(request, scene);
    const PlacedCamera placed =
        chooseCamera(scene, pose, request.camera, static_cast<double>(request.size.width) / request.size.height);
    return placed.tracked || physical(placed.camera) ? 1
                                                     : guessedMetresPerUnit(framedExtent(request, scene, pose, placed));
}

}  // namespace

void setScale(const Request& request, Scene& scene) {
    const std::optional<double> said = request.units ? request.units : scene.ownMetresPerUnit;
    if (said)
        scene.metresPerUnit = *said;
    else
        scene.metresPerUnit = saysLength(request) || scene.file.empty() ? 1 : guess(request, scene);
}

std::optional<std::string> guessedScaleNote(const Request& request, const Scene& scene) {
    if (request.units || scene.ownMetresPerUnit || scene.metresPerUnit == 1) return {};
    const std::string unit = unitOfMetres(scene.metresPerUnit);
    const bool named = std::isalpha(static_cast<unsigned char>(unit.front())) != 0;
    return fmt::format(
        "one unit of the scene is assumed to be {}{}, which gives the scene a plausible size; use --units m if it is 1 "
        "m",
        named ? "1 " + unit : unit, named ? "" : " m");
}

}  // namespace defocus::engine
