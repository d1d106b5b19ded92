#include "frame/setup/moment.h"

#include <algorithm>

#include "scene/animation.h"
#include "scene/hidden_nodes.h"

namespace defocus::engine {

int clipOf(const Request& request, const Scene& scene) {
    return request.clip.empty() ? 0 : clipNamed(scene, request.clip);
}

namespace {

// Returns `time` as a time within the animation, s; with Request::loop, it wraps at the animation's end.
double animationTime(const Request& request, const Scene& scene, double time) {
    if (!request.loop || scene.clips.empty()) return time;
    return loopedTime(scene.clips[static_cast<std::size_t>(clipOf(request, scene))], time);
}

}  // namespace

Pose exposedPose(const Request& request, const Scene& scene) {
    const double time = request.time + shutterMiddle(shutterSettings(request));
    Pose pose = poseAt(scene, animationTime(request, scene, time), clipOf(request, scene));
    hideNodes(scene, request.hide, pose);
    return pose;
}

void exposeMotion(const Request& request, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view) {
    const Scene& scene = *world.scene;
    const auto changesBlur = [](const Mesh& mesh) { return mesh.blurBounds.moves; };
    if (scene.clips.empty() && std::ranges::none_of(scene.meshes, changesBlur)) return;
    const auto momentAt = [&](double offset) {
        const double time = animationTime(request, scene, request.time + offset);
        ShutterMoment moment{unmeasuredPoseAt(scene, time, clipOf(request, scene)), {}};
        hideNodes(scene, request.hide, moment.pose);
        moment.worldFromCamera = worldFromCameraIn(camera, moment.pose);
        return moment;
    };
    openShutter(shutterSettings(request), settings, momentAt, world.shutter, view);
}

}  // namespace defocus::engine
