#include "capture/frame_sequence.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>
#include <optional>

#include "capture/shot_json.h"
#include "core/error.h"
#include "core/hash.h"
#include "lens/camera_lens.h"
#include "lens/lens_fields.h"
#include "plan/motion/camera_path.h"
#include "plan/visible/focus_depth.h"
#include "scene/animation.h"
#include "scene/hidden_nodes.h"

namespace defocus::engine {

namespace {

glm::dvec3 pointOf(const Place& place, const Scene& scene, const Pose& pose) {
    if (const auto* point = std::get_if<glm::dvec3>(&place)) return *point;
    return nodeCentre(scene, pose, nodeCalled(scene, std::get<std::string>(place)));
}

std::vector<Key<glm::dvec3>> pointsOf(const std::vector<Key<Place>>& keys, const Scene& scene, const Pose& pose) {
    std::vector<Key<glm::dvec3>> points;
    for (const Key<Place>& key : keys) points.push_back({key.frame, pointOf(key.value, scene, pose)});
    return points;
}

// Returns the fraction of a camera movement that is finished at `frame`: 0 at the movement's first frame, 1 at its last
// frame. `own`: range of the movement; nullopt: the range of the shot.
double placeIn(const std::optional<FrameRange>& own, const FrameRange& shot, double frame) {
    const FrameRange range = own.value_or(shot);
    const double length = std::max(1, range.last - range.first);
    return std::clamp((frame - range.first) / length, 0.0, 1.0);
}

// Returns the camera of the scene's file, moved by the animation; nullopt for the default camera, which shows the
// complete scene.
std::optional<PlacedCamera> cameraOfFile(const SequenceBase& base, const Pose& pose) {
    const bool none = base.scene->cameras.empty() && !base.scene->cameraTrack;
    if (none || std::holds_alternative<FramingCamera>(base.camera)) return {};
    return chooseCamera(*base.scene, pose, base.camera, static_cast<double>(base.view.width) / base.view.height);
}

// Returns the view at frame number `frame`, which may be fractional, with the camera's movement applied.
View movedView(const Shot& shot, const SequenceBase& base, const Pose& pose, double frame) {
    View view = base.view;
    const Scene& scene = *base.scene;
    if (const auto placed = cameraOfFile(base, pose); placed && !base.cameraStands)
        view.worldFromCamera = placed->worldFromCamera;
    if (const auto* keys = std::get_if<CameraKeys>(&shot.movement)) {
        const glm::dmat4 upright = lookingAt(valueAt(pointsOf(keys->positions, scene, pose), keys->easing, frame),
                                             valueAt(pointsOf(keys->targets, scene, pose), keys->easing, frame));
        const double roll = glm::radians(valueAt(keys->rolls, keys->easing, frame));
        view.worldFromCamera = roll == 0 ? upright : glm::rotate(upright, roll, glm::dvec3(0, 0, 1));
    }
    if (const auto* turntable = std::get_if<Turntable>(&shot.movement)) {
        const glm::dvec3 centre = turntable->centre ? pointOf(*turntable->centre, scene, pose) : base.centre;
        const double turns = turntable->turns * placeIn(turntable->frames, shot.range, frame);
        view = carriedAround(view, centre, 2 * std::numbers::pi * turns);
    }
    if (const auto* dolly = std::get_if<Dolly>(&shot.movement)) {
        const std::vector<Key<double>> ends = {{0, 0}, {1, dolly->distance}};
        view = dollied(view, valueAt(ends, dolly->easing, placeIn(dolly->frames, shot.range, frame)));
    }
    return view;
}

// Returns the distance (m) to the focus target. `view` must have the lens of the frame; the focus distance of that lens
// is ignored.
double focusDistanceOf(const FocusTarget& target, const Scene& scene, const Pose& pose, const View& view) {
    constexpr const char* who = "focus";
    if (const auto* node = std::get_if<FocusNode>(&target)) return depthOfNode(scene, pose, view, node->name, who);
    if (const auto* at = std::get_if<FocusPixel>(&target))
        return depthAtPixel(scene, pose, view, asVector(at->pixel), who);
    if (std::holds_alternative<FocusAuto>(target)) return depthOfMiddle(scene, pose, view, who);
    return std::get<FocusDistance>(target).metres;
}

double focusAt(const FocusTrack& focus, const Scene& scene, const FrameMoment& frame, const Lens& lens) {
    View view = frame.view;
    view.lens = lens;
    // Skip keyframes that don't affect this frame. The nodes on which they focus may be behind the camera in this
    // frame, which would be an error.
    std::vector<Key<double>> dioptres;
    for (std::size_t i = 0; i < focus.keys.size(); ++i) {
        const bool early = i + 2 < focus.keys.size() && focus.keys[i + 2].frame <= frame.frame;
        const bool late = i >= 2 && focus.keys[i - 2].frame > frame.frame;
        if (!early && !late)
            dioptres.push_back(
                {focus.keys[i].frame, 1 / focusDistanceOf(focus.keys[i].value, scene, frame.pose, view)});
    }
    return 1 / valueAt(dioptres, focus.easing, frame.frame);
}

double lensValueAt(const LensTrack& track, const LensField& field, double frame) {
    std::vector<Key<double>> keys = track.keys;
    if (keys.size() == 1) return keys.front().value;
    const bool positive = std::ranges::all_of(keys, [](const Key<double>& key) { return key.value > 0; });
    const bool stepped = !std::holds_alternative<double Lens::*>(field.member);
    if (stepped || (field.keyScale == KeyScale::logarithmic && !positive)) {
        const auto next = std::ranges::upper_bound(keys, frame, {}, [](const Key<double>& key) { return key.frame; });
        return next == keys.begin() ? next->value : std::prev(next)->value;
    }
    const auto interpolated = [&](double (*toScale)(double), double (*fromScale)(double)) {
        for (Key<double>& key : keys) key.value = toScale(key.value);
        return fromScale(valueAt(keys, track.easing, frame));
    };
    const auto reciprocal = [](double value) { return 1 / value; };
    switch (field.keyScale) {
        case KeyScale::linear:
            break;
        case KeyScale::logarithmic:
            return interpolated(std::log, std::exp);
        case KeyScale::reciprocal:
            return interpolated(reciprocal, reciprocal);
    }
    return valueAt(keys, track.easing, frame);
}

// Copies the camera's lens values, which may be animated, to the lens fields that the shot doesn't set.
void followCamera(const SequenceBase& base, const Camera& camera, Lens& lens) {
    std::map<std::string, double, std::less<>> own;
    for (const auto& [name, value] : camera.lens)
        if (!base.fixedLens.contains(name)) own.emplace(name, value);
    setLensFields(lens, own);  // warnings about invalid values have already been printed
    fitToCamera(lens, camera, static_cast<double>(base.view.width) / base.view.height,
                [&](std::string_view name) { return base.fixedLens.contains(name) || camera.lens.contains(name); });
}

Lens lensAt(const Shot& shot, const SequenceBase& base, const FrameMoment& frame) {
    Lens lens = frame.view.lens;
    if (const auto placed = cameraOfFile(base, frame.pose)) followCamera(base, placed->camera, lens);
    for (const auto& [name, track] : shot.lens) {
        const LensField& field = *lensFieldNamed(name);
        const double value = lensValueAt(track, field, frame.frame);
        setLensField(lens, field, std::clamp(value, field.min, field.max));  // interpolation may round beyond the range
    }
    if (shot.focus) lens.focusDistance = focusAt(*shot.focus, *base.scene, frame, lens);
    checkLens(lens);
    return lens;
}

// Returns the index of the shot's animation; −1 if the scene has no animation.
int clipOf(const Shot& shot, const Scene& scene) {
    if (scene.clips.empty()) return -1;
    return shot.request.clip.empty() ? 0 : clipNamed(scene, shot.request.clip);
}

double timeAt(const Shot& shot, const Scene& scene, int clip, double seconds) {
    const double time = shot.request.time + shot.animationSpeed * seconds;
    return shot.request.loop && clip >= 0 ? loopedTime(scene.clips[static_cast<std::size_t>(clip)], time) : time;
}

// Returns a random seed that differs for each frame and is unrelated to the seeds of the neighbouring frames.
std::uint32_t frameSeed(std::uint32_t seed, int frame) {
    return fmix32(seed + 0x9e3779b9u * (static_cast<std::uint32_t>(frame) + 1));
}

}  // namespace

FrameMoment frameAt(const Shot& shot, const SequenceBase& base, int frame) try {
    const int clip = clipOf(shot, *base.scene);
    FrameMoment result;
    result.frame = frame;
    result.time = timeAt(shot, *base.scene, clip, frame / shot.frameRate);
    const double middle = shutterMiddle(base.shutter);
    result.pose = poseAt(*base.scene, timeAt(shot, *base.scene, clip, frame / shot.frameRate + middle), clip);
    hideNodes(*base.scene, base.hidden, result.pose);
    result.lights = movedLights(base.lights, result.pose);
    result.view = movedView(shot, base, result.pose, frame + middle * shot.frameRate);
    result.view.lens = lensAt(shot, base, result);
    for (const auto& [name, track] : shot.methodKeys)
        result.view.methodValues[name] = valueAt(track.keys, track.easing, frame);
    result.settings = base.settings;
    if (shot.animateSeed) result.settings.seed = frameSeed(base.settings.seed, frame);

    // Motion blur needs the poses and cameras at several times while the shutter is open.
    const auto momentAt = [&](double offset) {
        ShutterMoment moment;
        const double seconds = frame / shot.frameRate + offset;
        moment.pose = shutterPoseAt(*base.scene, timeAt(shot, *base.scene, clip, seconds), clip, result.pose);
        moment.worldFromCamera = movedView(shot, base, moment.pose, seconds * shot.frameRate).worldFromCamera;
        return moment;
    };
    openShutter(base.shutter, result.settings, momentAt, result.shutter, result.view);
    return result;
} catch (const MissingName& missing) {
    failForName(shot, missing);
} catch (const Error& error) {
    fail("{}: frame {}: {}", shot.file.string(), frame, error.what());
}

std::vector<int> shardFrames(const FrameRange& range, int shard, int shards) {
    std::vector<int> frames;
    for (int frame = range.first; frame <= range.last; ++frame)
        if (frame % shards == shard) frames.push_back(frame);
    return frames;
}

}  // namespace defocus::engine
