#include "eval/popping/paths.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "core/enum_name.h"
#include "core/error.h"
#include "plan/frame_plan.h"
#include "plan/motion/camera_path.h"

namespace defocus::engine {

namespace {

constexpr double dollyLength = 0.5;  // length of the dolly as a fraction of the focus distance

struct Depths {
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
};

// Returns the depth range (m) of the objects in the view. Throws Error if the range is empty.
Depths depthsOf(const World& world, const View& view) {
    const RenderSettings settings{.sampleCount = 1, .lod = LodMode::off};
    Depths depths;
    for (const ObjectPlan& object : planFrame(world, view, settings).objects) {
        depths.nearest = std::min(depths.nearest, std::max(object.nearestDepth, view.nearPlane));
        depths.farthest = std::max(depths.farthest, object.farthestDepth);
    }
    if (depths.farthest <= depths.nearest)
        fail("no object is in front of the camera, so no level of detail can change");
    return depths;
}

View pulled(const View& view, const Depths& depths, double place) {
    View result = view;
    result.lens.focusDistance = focusBetween(depths.nearest, depths.farthest, place);
    return result;
}

View dolliedToPlace(const View& view, double focusDistance, double place) {
    const double forward = dollyLength * focusDistance * (place - 0.5);
    View result = dollied(view, forward);
    result.lens.focusDistance -= forward;
    return result;
}

// Returns the level of each object under LodMode::nearest, by object index.
std::map<int, std::uint32_t> nearestLevels(const World& world, const View& view, RenderSettings settings) {
    settings.lod = LodMode::nearest;
    std::map<int, std::uint32_t> levels;
    for (const ObjectPlan& object : planFrame(world, view, settings).objects) levels[object.object] = object.fine.level;
    return levels;
}

}  // namespace

const char* movementName(Movement movement) {
    return enumName<Movement::clip>(movement, {"focus-pull", "dolly", "turntable", "clip"});
}

std::vector<MovementFrame> framesAlong(Movement movement, const World& world, const View& view, int frames, int clip) {
    if (frames < 2) fail("a movement needs at least 2 frames, not {}", frames);
    const Scene& scene = *world.scene;
    if (movement == Movement::clip && (clip < 0 || static_cast<std::size_t>(clip) >= scene.clips.size()))
        fail("the scene has no animation {}", clip);
    const Depths depths = depthsOf(world, view);
    const glm::dvec3 centre = world.pose.bounds.centre();
    const double focusDistance =
        std::min(view.lens.focusDistance, depths.farthest);  // remains finite if the lens focuses at infinity
    std::vector<MovementFrame> result;
    for (int i = 0; i < frames; ++i) {
        const double place = static_cast<double>(i) / (frames - 1);
        switch (movement) {
            case Movement::focusPull:
                result.push_back({pulled(view, depths, place), world.pose});
                break;
            case Movement::dolly:
                result.push_back({dolliedToPlace(view, focusDistance, place), world.pose});
                break;
            case Movement::turntable:
                result.push_back({carriedAround(view, centre, 2 * std::numbers::pi * (place - 0.5)), world.pose});
                break;
            case Movement::clip:
                result.push_back(
                    {view, poseAt(scene, place * scene.clips[static_cast<std::size_t>(clip)].duration, clip)});
                break;
        }
    }
    return result;
}

void poseWorld(World& world, const MovementFrame& frame) {
    world.pose = frame.pose;
    world.lights = movedLights(world.lights, frame.pose);
}

std::vector<MovementFrame> busiestStretch(const std::vector<MovementFrame>& frames, World& world,
                                          const RenderSettings& settings, int length) {
    if (length < 1 || static_cast<std::size_t>(length) > frames.size())
        fail("cannot measure {} frames; choose 1 to {}, the number of frames of the movement", length, frames.size());

    // For each frame, the number of level changes from the first frame up to this frame.
    std::vector<int> changes;
    std::map<int, std::uint32_t> levels;
    for (const MovementFrame& frame : frames) {
        poseWorld(world, frame);
        const std::map<int, std::uint32_t> before = std::exchange(levels, nearestLevels(world, frame.view, settings));
        int changed = 0;
        for (const auto& [object, level] : levels) {
            const auto earlier = before.find(object);
            changed += earlier != before.end() && earlier->second != level ? 1 : 0;
        }
        changes.push_back((changes.empty() ? 0 : changes.back()) + changed);
    }

    const auto count = static_cast<std::size_t>(length);
    std::size_t best = 0;
    int max = -1;
    for (std::size_t first = 0; first + count <= frames.size(); ++first) {
        const int within = changes[first + count - 1] - changes[first];
        if (within <= max) continue;
        max = within;
        best = first;
    }
    const auto begin = frames.begin() + static_cast<std::ptrdiff_t>(best);
    return {begin, begin + length};
}

}  // namespace defocus::engine
