// Applies the settings in the window's state (its request) to the document's world. Panels, keys and undo change only
// the request.

#include <algorithm>
#include <tuple>

#include "core/error.h"
#include "frame/settings/settings.h"
#include "frame/setup/moment.h"
#include "frame/setup/shared_scene.h"
#include "scene/ground.h"
#include "view/document/document.h"

namespace defocus::engine {

namespace {

// Each lambda below selects (with std::tie) the members of a request that are compared, applied and reverted together.
constexpr auto cameraPart = [](auto& request) { return std::tie(request.camera); };
constexpr auto aperturePart = [](auto& request) { return std::tie(request.lens.apertureImage); };
constexpr auto nodeBlurPart = [](auto& request) { return std::tie(request.nodeBlur); };
constexpr auto posePart = [](auto& request) {
    return std::tie(request.time, request.clip, request.shutter, request.shutterPosition, request.motionSegments,
                    request.hide);
};
constexpr auto groundPart = [](auto& request) { return std::tie(request.ground); };
constexpr auto surroundingsPart = [](auto& request) {
    return std::tie(request.environment, request.environmentRotation, request.background);
};
constexpr auto lightsPart = [](auto& request) { return std::tie(request.lightAngle, request.lightRadius); };

// Calls `update` if the members that `part` selects differ between the state's request and the request that is shown.
// If `update` throws, resets these members of the state to the values that are shown.
template <typename Part, typename Update>
void apply(const Part& part, Document& document, ViewState& state, const Update& update) {
    if (part(state.options) == part(document.shown)) return;
    try {
        update();
        part(document.shown) = part(state.options);
    } catch (const Error& error) {
        sayFault(state, error.what());
        part(state.options) = part(document.shown);
    }
}

// Returns the state's request with the file's camera `camera`. Removes the camera position of the request. If the focus
// depends on pixels of the image, uses the camera's own focus instead.
Request cameraRequest(const ViewState& state, const CameraChoice& camera) {
    Request request = state.options;
    request.camera = camera;
    request.cameraPosition = request.cameraTarget = request.cameraUp = std::nullopt;
    const bool needsPixels = std::holds_alternative<FocusPixel>(request.focus) ||
                             std::holds_alternative<FocusPoints>(request.focus) ||
                             std::holds_alternative<FocusAuto>(request.focus);
    if (needsPixels) request.focus = CameraFocus{};
    request.size = {state.pictureSize.x, state.pictureSize.y};
    return request;
}

void updateLights(Document& document, const ViewState& state) {
    PreparedFrame& frame = *document.frame;
    frame.world.lights = sizedLights(state.options, frame.ownLights, frame.world.pose);
    ++document.poseVersion;
}

// Returns the scene file's camera that the view follows, where the current pose places it. If the view follows no
// camera, returns a camera at the view's position.
PlacedCamera followedCamera(const Document& document, const ViewState& state) {
    const double aspect = static_cast<double>(state.pictureSize.x) / state.pictureSize.y;
    const PreparedFrame& frame = *document.frame;
    PlacedCamera placed;
    if (state.followsCamera) placed = chooseCamera(*frame.scene, frame.world.pose, state.options.camera, aspect);
    if (!state.followsCamera || placed.camera.name == "auto") {
        placed = {};
        placed.worldFromCamera = state.camera.worldFromCamera;
    }
    return placed;
}

// Poses the world according to state.options. Clears the selection if the selected object is hidden.
void updatePose(Document& document, ViewState& state) {
    const Scene& scene = *document.frame->scene;
    World& world = document.frame->world;
    Pose pose = exposedPose(state.options, scene);
    if (state.selected >= 0) {
        const Object& selected = world.pose.objects[static_cast<std::size_t>(state.selected)];
        const auto found = std::ranges::find_if(pose.objects, [&](const Object& object) {
            return object.node == selected.node && object.name == selected.name;
        });
        state.selected = found == pose.objects.end() ? -1 : static_cast<int>(found - pose.objects.begin());
    }
    world.pose = std::move(pose);
    updateLights(document, state);
    const PlacedCamera camera = followedCamera(document, state);
    state.camera.worldFromCamera = camera.worldFromCamera;
    View view = currentView(document, state);
    exposeMotion(state.options, camera, renderSettings(state.options), world, view);
    document.shutterCameras = view.shutterCameras;
    document.poseIsStale = false;
}

void updateNodeBlur(Document& document, ViewState& state) {
    Scene& scene = *document.frame->scene;
    const std::size_t count =
        std::min(scene.nodes.size(), document.ownBlurs.size());  // one of the two lists may lack the ground's node
    for (std::size_t i = 0; i < count; ++i) scene.nodes[i].cocScale = document.ownBlurs[i];
    setNodeBlur(state.options, scene);
    updatePose(document, state);
}

void updateGround(Document& document, ViewState& state) {
    Scene& scene = *document.frame->scene;
    if (hasGround(scene)) removeGround(scene);
    setGround(state.options, scene);
    SharedPyramids& pyramids = document.frame->world.pyramids;
    pyramids.resize(std::min(pyramids.size(), scene.meshes.size()));
    while (pyramids.size() < scene.meshes.size()) pyramids.push_back(fullDetail(scene.meshes[pyramids.size()]));
    updatePose(document, state);
    ++document.worldVersion;
}

void updateSurroundings(Document& document, ViewState& state) {
    PreparedFrame& frame = *document.frame;
    frame.world.environment = chosenEnvironment(state.options, *frame.scene, frame.world.pose);
    state.environmentPath = state.options.environment.string();
    ++document.worldVersion;
}

}  // namespace

void updateWorld(Document& document, ViewState& state, bool held) {
    const auto update = [&](const auto& part, void (*function)(Document&, ViewState&)) {
        apply(part, document, state, [&] { function(document, state); });
    };
    apply(cameraPart, document, state,
          [&] { placeCamera(*document.frame, cameraRequest(state, state.options.camera)); });
    apply(aperturePart, document, state, [&] {
        const std::filesystem::path& path = state.options.lens.apertureImage;
        state.lens.apertureImage = path.empty() ? document.frame->cameraLens.apertureImage : loadApertureImage(path);
    });
    if (!document.draft) update(groundPart, updateGround);
    update(nodeBlurPart, updateNodeBlur);
    update(posePart, updatePose);
    if (document.poseIsStale) updatePose(document, state);
    if (!held) update(surroundingsPart, updateSurroundings);
    apply(lightsPart, document, state, [&] { updateLights(document, state); });
}

void switchCamera(Document& document, ViewState& state, const std::string& name) {
    Request named;
    setByName(named, "camera", name);
    const Request request = cameraRequest(state, named.camera);
    PreparedFrame& frame = *document.frame;
    placeCamera(frame, request);
    state.options = request;
    document.shown.camera = named.camera;
    state.lens = frame.view.lens;
    state.pull.reset();
    state.camera = {frame.view.worldFromCamera, std::clamp(state.lens.focusDistance, 1e-3, 1e6)};
    state.nearPlane = wanderingNearPlane(frame.view.nearPlane, frame.world.pose.bounds);
    state.followsCamera = true;
    document.poseIsStale = !frame.scene->clips.empty() || frame.scene->cameraTrack;
    document.shutterCameras.clear();
}

}  // namespace defocus::engine
