#include "frame/setup/moment.h"

#include <algorithm>

#include "scene/animation.h"
#include "scene/hidden_nodes.h"

namespace defocus::engine {

int clipOf(const Request& request, const Scene& scene) {
    return request.clip.empty() ? 0 : clipNamed(scene, request.clip);
}

ShutterSettings shutterOf(const Request& request, const Scene& scene) {
    ShutterSettings shutter = shutterSettings(request);
    if (request.shutter || !scene.cameraTrack || !scene.cameraTrack->shutter) return shutter;
    const ShutterInterval& own = *scene.cameraTrack->shutter;
    shutter.seconds = own.close - own.open;
    shutter.opening = own.open;
    return shutter;
}

namespace {

// Converts `time` (s) to a time within the animation (s). With Request::loop, the time wraps at the animation's end.
double animationTime(const Request& request, const Scene& scene, double time) {
    if (!request.loop || scene.clips.empty()) return time;
    return loopedTime(scene.clips[static_cast<std::size_t>(clipOf(request, scene))], time);
}

}  // namespace

Pose exposedPose(const Request& request, const Scene& scene) {
    const double time = request.time + shutterMiddle(shutterOf(request, scene));
    Pose pose = poseAt(scene, animationTime(request, scene, time), clipOf(request, scene));
    hideNodes(scene, request.hide, pose);
    return pose;
}

void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view) {
    const Scene& scene = *world.scene;
    const auto changesBlur = [](const Mesh& mesh) { return mesh.blurBounds.moves; };
    const bool cameraMoves = scene.cameraTrack && scene.cameraTrack->moves;
    if (scene.clips.empty() && !cameraMoves && std::ranges::none_of(scene.meshes, changesBlur)) return;
    const auto momentAt = [&](double offset) {
        const double time = animationTime(request, scene, request.time + offset);
        ShutterMoment moment{shutterPoseAt(scene, time, clipOf(request, scene), world.pose), {}};
        moment.worldFromCamera = worldFromCameraIn(camera, moment.pose);
        return moment;
    };
    openShutter(shutterOf(request, scene), settings, momentAt, world.shutter, view);
}

}  // namespace defocus::engine
