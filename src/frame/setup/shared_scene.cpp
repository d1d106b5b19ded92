#include "frame/setup/shared_scene.h"

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "frame/setup/moment.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/scene_scale.h"
#include "lens/camera_lens.h"
#include "scene/camera_files/camera_source.h"
#include "scene/gltf/gltf.h"
#include "scene/ground.h"
#include "scene/hidden_nodes.h"
#include "scene/strokes.h"
#include "school/fish_school.h"

namespace defocus::engine {

namespace {

// Returns whether the scene's camera track comes from the camera file that the request names; true if neither exists.
bool hasCameraTrack(const Request& request, const Scene& scene) {
    return request.cameraFrom == (scene.cameraTrack ? scene.cameraTrack->source : std::string());
}

// Opens the camera file that the request names, or removes the camera of an earlier request.
void setCameraTrack(const Request& request, Scene& scene) {
    if (hasCameraTrack(request, scene)) return;
    scene.cameraTrack =
        request.cameraFrom.empty() ? nullptr : std::make_shared<CameraTrack>(openCamera(request.cameraFrom));
}

// Returns the scene with its points and lines as triangles.
std::shared_ptr<Scene> drawnStrokes(const Request& request, const std::shared_ptr<Scene>& scene) {
    PreparedFrame frame;
    frame.scene = scene;
    frame.world.pose = exposedPose(request, *scene);
    placeCamera(frame, request);
    const View& view = frame.view;
    const double pixel = 2 * tanHalfHorizontalFov(view.lens) / view.width;
    Request shown = request;
    shown.hide.clear();  // include hidden nodes, because a later request may show them
    return std::make_shared<Scene>(
        withStrokes(*scene, exposedPose(shown, *scene), {view.worldFromCamera, pixel, view.nearPlane}));
}

}  // namespace

SharedScene::SharedScene(const Request& request, const Progress& progress)
    : loaded_(std::make_shared<Scene>(loadScene(request, progress))) {
    setCameraTrack(request, *loaded_);
    setScale(request, *loaded_);
    if (hasStrokes(*loaded_)) loaded_ = drawnStrokes(request, loaded_);
}

SharedScene::SharedScene(std::shared_ptr<const Scene> scene, const Request& request)
    : loaded_(std::const_pointer_cast<Scene>(std::move(scene))) {
    if (hasStrokes(*loaded_)) loaded_ = drawnStrokes(request, loaded_);
}

std::shared_ptr<Scene> SharedScene::of(const Request& request) {
    const double metresPerUnit = request.units.value_or(loaded_->metresPerUnit);
    const auto suits = [&](const Scene& scene) {
        return metresPerUnit == scene.metresPerUnit && hasCameraTrack(request, scene);
    };
    // The ground lies beneath the pose at the start of the clip.
    const bool sameGround = request.ground == request_.ground && (!request.ground || request.clip == request_.clip);
    const bool sameAsLatest = latest_ && suits(*latest_) && request.nodeBlur == request_.nodeBlur && sameGround;
    if (!sameAsLatest) {
        if (request.nodeBlur.empty() && !request.ground && suits(*loaded_)) {
            latest_ = loaded_;
        } else {
            auto changed = std::make_shared<Scene>(*loaded_);
            setNodeBlur(request, *changed);
            setCameraTrack(request, *changed);
            changed->metresPerUnit = metresPerUnit;
            setGround(request, *changed);
            latest_ = std::move(changed);
        }
    }
    request_ = request;
    return latest_;
}

Scene loadScene(const Request& request, const Progress& progress) {
    if (!request.scene.empty()) {
        Scene scene = loadGltf(request.scene, progress, request.variant);
        if (const std::vector<std::string> damage = damageWarnings(scene); request.strict && !damage.empty())
            fail("{}: {}; leave out --strict to draw the rest", request.scene.string(), damage.front());
        return scene;
    }
    FishSchoolOptions school;
    school.fishCount = request.fishCount;
    school.trianglesPerFish = request.trianglesPerFish;
    return fishSchool(school, progress);
}

void setNodeBlur(const Request& request, Scene& scene) {
    for (const auto& [name, scale] : request.nodeBlur)
        scene.nodes[static_cast<std::size_t>(nodeCalled(scene, name))].cocScale = scale;
}

void setGround(const Request& request, Scene& scene) {
    if (request.ground && !hasGround(scene)) addGround(scene, poseAt(scene, 0, clipOf(request, scene)));
}

}  // namespace defocus::engine
