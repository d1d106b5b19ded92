#include "frame/moment.h"

#include "scene/animation.h"

namespace defocus {

namespace {

int clipOf(const SceneOptions& options, const Scene& scene) {
    return options.clip.empty() ? 0 : clipNamed(scene, options.clip);
}

// Where `time` lies in the animation.
double animationTime(const SceneOptions& options, const Scene& scene, double time) {
    if (!options.loop || scene.clips.empty()) return time;
    return loopedTime(scene.clips[static_cast<std::size_t>(clipOf(options, scene))], time);
}

}  // namespace

Pose exposedPose(const SceneOptions& options, const Scene& scene) {
    const double time = options.time + shutterMiddle(options.shutter);
    return poseAt(scene, animationTime(options, scene, time), clipOf(options, scene));
}

void exposeMotion(const SceneOptions& options, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                  View& view) {
    const Scene& scene = *world.scene;
    if (scene.clips.empty()) return;
    const auto momentAt = [&](double offset) {
        const double time = animationTime(options, scene, options.time + offset);
        ShutterMoment moment{unmeasuredPoseAt(scene, time, clipOf(options, scene)), {}};
        moment.worldFromCamera = worldFromCameraIn(camera, moment.pose);
        return moment;
    };
    openShutter(options.shutter, settings, momentAt, world.shutter, view);
}

}  // namespace defocus
