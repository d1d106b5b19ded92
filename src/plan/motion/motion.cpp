// Plans motion blur. Source: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic
// Rasterization. Vertices and their circles of confusion C change linearly between the opening and the closing of the
// shutter.
#include "plan/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "core/error.h"
#include "plan/motion/object_pose.h"

namespace defocus::engine {

namespace {

constexpr double stillness = 1e-9;  // max change of a matrix at rest, relative to the matrix's largest element

std::size_t momentCount(const World& world, const View& view) {
    return std::max(world.shutter.poses.size(), view.shutterCameras.size());
}

bool nearlyEqual(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0;
    double difference = 0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            largest = std::max(largest, std::abs(a[column][row]));
            difference = std::max(difference, std::abs(a[column][row] - b[column][row]));
        }
    return difference <= stillness * largest;
}

bool nearlyEqual(const ObjectPose& a, const ObjectPose& b) {
    return std::equal(a.viewFromJoint.begin(), a.viewFromJoint.end(), b.viewFromJoint.begin(), b.viewFromJoint.end(),
                      [](const glm::dmat4& x, const glm::dmat4& y) { return nearlyEqual(x, y); }) &&
           std::equal(a.morphWeights.begin(), a.morphWeights.end(), b.morphWeights.begin(), b.morphWeights.end(),
                      [](double x, double y) { return std::abs(x - y) <= stillness; });
}

}  // namespace

void checkShutter(const World& world, const View& view, const RenderSettings& settings) {
    const std::size_t count = momentCount(world, view);
    if (count == 0) return;
    const std::size_t needed = world.shutter.perSample ? settings.sampleCount : 2;
    if (count < needed) fail("the shutter interval has {} time samples; at least {} are needed", count, needed);
    const bool camerasFit = view.shutterCameras.empty() || view.shutterCameras.size() == count;
    const bool posesFit = world.shutter.poses.empty() || world.shutter.poses.size() == count;
    if (!camerasFit || !posesFit)
        fail("the shutter interval has {} poses of the scene, but {} poses of the camera; give the same number of both",
             world.shutter.poses.size(), view.shutterCameras.size());
    for (const Pose& pose : world.shutter.poses)
        if (pose.objects.size() != world.pose.objects.size())
            fail("the scene has {} objects at one time sample of the shutter interval, but {} at another",
                 pose.objects.size(), world.pose.objects.size());
}

std::vector<ObjectPose> objectMotion(const World& world, const View& view, std::size_t object, const ObjectPose& pose) {
    std::vector<ObjectPose> motion;
    const std::size_t count = momentCount(world, view);
    bool still = true;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dmat4& camera = view.shutterCameras.empty() ? view.worldFromCamera : view.shutterCameras[i];
        const Pose& scene = world.shutter.poses.empty() ? world.pose : world.shutter.poses[i];
        motion.push_back(objectPose(scene.objects[object], glm::inverse(camera)));
        still = still && nearlyEqual(motion.back(), pose);
    }
    if (still) motion.clear();
    return motion;
}

bool shutterIsOpen(const World& world, const View& view) {
    return momentCount(world, view) > 0;
}

void planMoments(FramePlan& plan, const World& world, const std::vector<ObjectPlan>& casters) {
    const auto moves = [](const ObjectPlan& object) { return !object.motion.empty() || object.blurMoves; };
    if (std::ranges::none_of(plan.objects, moves) && std::ranges::none_of(casters, moves)) return;
    const auto segments = static_cast<double>(momentCount(world, plan.view) - 1);
    for (std::size_t i = 0; i < plan.samples.size(); ++i) {
        const float time = plan.samples[i].time;
        if (world.shutter.perSample) {
            plan.moments.push_back({static_cast<std::uint32_t>(i), 0, time});
            continue;
        }
        const double place = segments * static_cast<double>(time);
        const double moment = std::floor(place);
        plan.moments.push_back({static_cast<std::uint32_t>(moment), static_cast<float>(place - moment), time});
    }
    const glm::dmat4 middleFromWorld = glm::inverse(plan.view.worldFromCamera);
    for (const glm::dmat4& worldFromCamera : plan.view.shutterCameras)
        plan.middleFromView.push_back(middleFromWorld * worldFromCamera);
    if (std::all_of(plan.middleFromView.begin(), plan.middleFromView.end(),
                    [](const glm::dmat4& matrix) { return nearlyEqual(matrix, glm::dmat4(1)); }))
        plan.middleFromView.clear();
}

}  // namespace defocus::engine
