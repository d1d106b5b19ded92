// The scene of a view: taken over from the loader, posed at its time, seen by a camera.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "core/error.h"
#include "core/message.h"
#include "frame/exposure.h"
#include "frame/moment.h"
#include "scene/animation.h"
#include "scene/ground.h"
#include "view/recent_files.h"
#include "view/session.h"

namespace defocus {

namespace {

// What --clip calls a clip: its name, or its number where another has that name.
std::string clipText(const Scene& scene, int clip) {
    const std::string& name = scene.clips[static_cast<std::size_t>(clip)].name;
    return !name.empty() && clipNamed(scene, name) == clip ? name : std::to_string(clip);
}

}  // namespace

void ViewSession::takeScene() {
    std::optional<LoadedScene> loaded = loader_.take();
    if (!loaded) return;
    if (!loaded->frame) {
        say(loaded->fault, true);
    } else if (frame_ && frame_->scene == loaded->frame->scene) {
        refineScene(*loaded->frame);
    } else {
        adoptScene(std::move(*loaded));
    }
}

// The draft that is shown gets its pyramids; whatever has been done meanwhile stays.
void ViewSession::refineScene(PreparedFrame& frame) {
    picture_.reset();
    frame_->world.pyramids = std::move(frame.world.pyramids);
    draft_ = false;
    if (!frame.cacheFailure.empty()) say("simplified meshes are not kept: " + frame.cacheFailure, true);
    makePicture();
}

void ViewSession::adoptScene(LoadedScene scene) {
    export_.reset();
    picture_.reset();
    frame_ = std::move(scene.frame);
    draft_ = scene.draft;
    state_.options = scene.options;
    state_.environmentPath = scene.options.environment.string();
    state_.aperturePath = scene.options.lens.apertureImage.string();
    const int clip = scene.options.clip.empty() ? 0 : clipNamed(*frame_->scene, scene.options.clip);
    state_.animation = {.clip = clip, .time = scene.options.time, .speed = state_.animation.speed, .playing = false};
    posedTime_ = state_.animation.time;
    posedClip_ = clip;
    posedShutter_ = state_.options.shutter;
    lightAngle_ = state_.options.lightAngle;
    lightRadius_ = state_.options.lightRadius;
    shutterCameras_ = frame_->view.shutterCameras;
    state_.selected = -1;
    state_.shotKeys.clear();
    state_.poppingSince.reset();
    state_.lens = frame_->view.lens;
    state_.pull.reset();
    state_.focusPoints.clear();
    state_.camera.worldFromCamera = frame_->view.worldFromCamera;
    const Bounds& bounds = frame_->world.pose.bounds;
    const double depth =
        bounds.empty() ? 0 : -(glm::inverse(frame_->view.worldFromCamera) * glm::dvec4(bounds.centre(), 1)).z;
    state_.camera.pivotDistance = depth > 0 ? depth : std::min(state_.lens.focusDistance, 1e6);
    state_.followsCamera = !scene.options.cameraPosition && !scene.options.cameraTarget && !scene.options.cameraUp;
    state_.nearPlane = wanderingNearPlane(frame_->view.nearPlane, bounds);
    state_.display.exposure = metersExposure(scene.options, *frame_->scene, state_.lens)
                                  ? meteredExposure(frame_->world, frame_->view, frame_->settings, shaderFolder_)
                                  : scene.options.exposure.value_or(state_.display.exposure);
    if (frame_->scaleNote) say(*frame_->scaleNote);
    for (const std::string& line : frame_->refusedLensValues)
        say(fmt::format("camera '{}': {}; not used", frame_->cameraName, line), true);
    if (!frame_->cacheFailure.empty()) say("simplified meshes are not kept: " + frame_->cacheFailure, true);
    makePicture();
    window_.setTitle(frame_->sceneName + " – defocus");
    state_.meters = scene.options.exposureAuto;
    state_.marker.shown = false;
    meterDue_ = false;
    nodeBlurs_.clear();
    for (const Node& node : frame_->scene->nodes) nodeBlurs_.push_back(node.cocScale);
    history_.begin(currentEdit());
    keepMemory();
}

// What outlasts the window: the scenes that were opened, and the views that were kept of this one.
void ViewSession::keepMemory() {
    const std::filesystem::path& file = state_.options.scene;
    try {
        if (!file.empty() && options_.frames == 0) rememberRecentFile(recentFilesPath(), file);
    } catch (const Error& error) {
        if (!quiet_) printMessage("warning: recent files are not kept: {}\n", error.what());
    }
    state_.recent = readRecentFiles(recentFilesPath());
    state_.savedViews.clear();
    try {
        state_.savedViews = readSavedViews(savedViewsPath(), savedViewsKey(file));
    } catch (const Error& error) {
        say(error.what(), true);
    }
}

void ViewSession::moveThings(double seconds) {
    if (!frame_) return;
    const InputContext context = inputContext();
    input_.fly(context, seconds, state_);
    if (state_.pull) {
        state_.lens.focusDistance = state_.pull->distanceAt(now());
        if (state_.pull->over(now())) state_.pull.reset();
    }
    if (state_.poppingSince && now() - *state_.poppingSince > poppingDuration) actions_.togglePopping = true;

    if (state_.options.lightAngle != lightAngle_ || state_.options.lightRadius != lightRadius_) lightTheScene();

    AnimationState& animation = state_.animation;
    const std::vector<AnimationClip>& clips = frame_->scene->clips;
    if (clips.empty()) {
        animation.playing = false;
        return;
    }
    animation.clip = std::clamp(animation.clip, 0, static_cast<int>(clips.size()) - 1);
    const double duration =
        std::max(1e-3, static_cast<double>(clips[static_cast<std::size_t>(animation.clip)].duration));
    if (animation.playing) animation.time += animation.speed * std::min(seconds, 0.25);
    if (animation.playing || animation.time < 0) animation.time -= std::floor(animation.time / duration) * duration;
    const bool posed =
        animation.time == posedTime_ && animation.clip == posedClip_ && state_.options.shutter == posedShutter_;
    if (!posed) poseScene();
}

void ViewSession::poseScene() {
    if (export_) return;  // the still that is being rendered stands
    const AnimationState& animation = state_.animation;
    const Scene& scene = *frame_->scene;
    World& world = frame_->world;
    state_.options.time = animation.time;
    state_.options.clip = animation.clip == 0 ? "" : clipText(scene, animation.clip);
    world.pose = exposedPose(state_.options, scene);
    lightTheScene();
    PlacedCamera standing;
    standing.worldFromCamera = state_.camera.worldFromCamera;
    const PlacedCamera camera = followedCamera().value_or(standing);
    state_.camera.worldFromCamera = camera.worldFromCamera;
    View view = currentView();
    exposeMotion(state_.options, camera, state_.options.settings, world, view);
    shutterCameras_ = view.shutterCameras;
    posedTime_ = animation.time;
    posedClip_ = animation.clip;
    posedShutter_ = state_.options.shutter;
}

// The lights stand where the pose has them, of the sizes that the options ask for.
void ViewSession::lightTheScene() {
    lightAngle_ = state_.options.lightAngle;
    lightRadius_ = state_.options.lightRadius;
    frame_->world.lights = sizedLights(state_.options, frame_->ownLights, frame_->world.pose);
    ++poseVersion_;
}

// The file's camera at this time, where it is what the view follows.
std::optional<PlacedCamera> ViewSession::followedCamera() const {
    if (!state_.followsCamera) return std::nullopt;
    const glm::ivec2 size = pictureSize();
    PlacedCamera placed = defocus::chooseCamera(*frame_->scene, frame_->world.pose, state_.options.camera,
                                                static_cast<double>(size.x) / size.y);
    return placed.camera.name == "auto" ? std::nullopt : std::optional(std::move(placed));
}

void ViewSession::chooseCamera(const std::string& name) {
    if (!frame_) return;
    Request options = state_.options;
    options.camera = name;
    options.cameraPosition.reset();
    options.cameraTarget.reset();
    options.cameraUp.reset();
    options.focusPixel.reset();
    options.focusPoints.clear();
    options.focusAuto = false;
    const glm::ivec2 size = pictureSize();
    options.width = size.x;
    options.height = size.y;
    placeCamera(*frame_, options);
    state_.options = options;
    state_.lens = frame_->view.lens;
    state_.pull.reset();
    state_.camera = {frame_->view.worldFromCamera, std::clamp(frame_->view.lens.focusDistance, 1e-3, 1e6)};
    state_.nearPlane = wanderingNearPlane(frame_->view.nearPlane, frame_->world.pose.bounds);
    state_.followsCamera = true;
    shutterCameras_.clear();
    if (!frame_->scene->clips.empty()) poseScene();
}

// Puts a ground beneath the scene or takes it away, with its levels.
void ViewSession::changeGround(const Request& options) {
    if (draft_) {
        say("a ground needs the scene's levels, which are still being made");
        return;
    }
    picture_.reset();  // it has the scene on the GPU
    state_.selected = -1;
    Scene& scene = *frame_->scene;
    if (options.ground)
        setGround(options, scene);
    else
        removeGround(scene);
    frame_->world.pyramids.resize(std::min(frame_->world.pyramids.size(), scene.meshes.size()));
    while (frame_->world.pyramids.size() < scene.meshes.size())
        frame_->world.pyramids.push_back(fullDetail(scene.meshes[frame_->world.pyramids.size()]));
    state_.options = options;
    poseScene();
    makePicture();
}

// Leaves out other nodes. What is selected stays so where it is still there.
void ViewSession::hide(const Request& options) {
    const auto called = [&](int object) {
        return object < 0 ? std::pair(-1, std::string())
                          : std::pair(frame_->world.pose.objects[static_cast<std::size_t>(object)].node,
                                      frame_->world.pose.objects[static_cast<std::size_t>(object)].name);
    };
    const auto before = called(state_.selected);
    state_.options = options;
    state_.selected = -1;
    poseScene();
    for (int i = 0; i < static_cast<int>(frame_->world.pose.objects.size()); ++i)
        if (called(i) == before) state_.selected = i;
}

// The blur of nodes becomes that of `options`, or surroundings and aperture image. Throws Error before anything has
// changed.
void ViewSession::change(const Request& options) {
    if (options.nodeBlur != state_.options.nodeBlur) {
        for (const auto& [name, scale] : options.nodeBlur)
            frame_->scene->nodes[static_cast<std::size_t>(nodeNamed(*frame_->scene, name))].cocScale = scale;
        state_.options = options;
        poseScene();
        return;
    }
    if (options.hidden != state_.options.hidden) {
        hide(options);
        return;
    }
    if (options.ground != hasGround(*frame_->scene)) {
        changeGround(options);
        return;
    }
    const Environment environment = chosenEnvironment(options, *frame_->scene, frame_->world.pose);
    const std::shared_ptr<const Image> aperture = options.lens.apertureImage.empty()
                                                      ? frame_->cameraLens.apertureImage
                                                      : loadApertureImage(options.lens.apertureImage);
    state_.lens.apertureImage = aperture;
    state_.options = options;
    picture_.reset();  // it has the surroundings on the GPU
    frame_->world.environment = environment;
    makePicture();
}

void ViewSession::frameBounds(bool selection) {
    if (!frame_) return;
    const World& world = frame_->world;
    Bounds bounds = world.pose.bounds;
    if (selection && state_.selected >= 0) {
        const Object& object = world.pose.objects[static_cast<std::size_t>(state_.selected)];
        bounds = transformed(world.pyramids[static_cast<std::size_t>(object.mesh)].bounds, object.worldFromObject);
    }
    const glm::dvec2 tangents = tanHalfFov(state_, area());
    state_.camera = framed(state_.camera, bounds, tangents.x, tangents.y);
    state_.followsCamera = false;
    pullFocus(state_, state_.camera.pivotDistance, now());
}

}  // namespace defocus
