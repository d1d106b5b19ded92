#include "app/exposure.h"

#include <algorithm>

#include "lens/lens_samples.h"
#include "scene/animation.h"

namespace defocus {

namespace {

// From the frame's time to the opening of its shutter, s.
double openingOffset(const SceneOptions& options) {
    switch (options.shutterPosition) {
        case ShutterPosition::start:
            return 0;
        case ShutterPosition::centre:
            return -0.5 * options.shutter;
        case ShutterPosition::end:
            return -options.shutter;
    }
    return 0;
}

int clipOf(const SceneOptions& options, const Scene& scene) {
    return options.clip.empty() ? 0 : clipNamed(scene, options.clip);
}

// `share` of the exposure has passed: the time in the animation.
double animationTime(const SceneOptions& options, const Scene& scene, double share) {
    const double time = options.time + openingOffset(options) + share * options.shutter;
    if (!options.loop || scene.clips.empty()) return time;
    return loopedTime(scene.clips[static_cast<std::size_t>(clipOf(options, scene))], time);
}

// Of the moments whose poses are needed: which share of the exposure has passed.
std::vector<double> shutterShares(const SceneOptions& options, const Lens& lens, const RenderSettings& settings) {
    std::vector<double> shares;
    if (options.exactMotion)
        for (std::uint32_t i = 0; i < settings.sampleCount; ++i)
            shares.push_back(
                static_cast<double>(lensSample(lens, std::uint64_t{settings.firstSample} + i, settings.seed).time));
    else
        for (std::uint32_t i = 0; i <= options.motionSegments; ++i)
            shares.push_back(static_cast<double>(i) / options.motionSegments);
    return shares;
}

}  // namespace

Pose exposedPose(const SceneOptions& options, const Scene& scene) {
    return poseAt(scene, animationTime(options, scene, 0.5), clipOf(options, scene));
}

void openShutter(const SceneOptions& options, const PlacedCamera& camera, const RenderSettings& settings, World& world,
                 View& view) {
    world.shutter = {};
    view.shutterCameras.clear();
    if (!(options.shutter > 0) || world.scene->clips.empty()) return;
    world.shutter.perSample = options.exactMotion;
    const int clip = clipOf(options, *world.scene);
    for (const double share : shutterShares(options, view.lens, settings)) {
        world.shutter.poses.push_back(
            unmeasuredPoseAt(*world.scene, animationTime(options, *world.scene, share), clip));
        view.shutterCameras.push_back(worldFromCameraIn(camera, world.shutter.poses.back()));
    }
    const auto still = [&](const glm::dmat4& moment) { return moment == view.worldFromCamera; };
    if (std::all_of(view.shutterCameras.begin(), view.shutterCameras.end(), still)) view.shutterCameras.clear();
}

}  // namespace defocus
