#include "view/document/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/matrix.hpp>

#include "core/error.h"
#include "frame/settings/settings.h"
#include "frame/setup/exposure.h"
#include "view/document/kept_files.h"

namespace defocus::engine {

namespace {

Request withoutScene(Request options) {
    for (const Setting& setting : settings())
        if (dependsOnScene(setting)) setting.clear(options);
    return options;
}

// Adds the scene to the recent files, and reads the list of recent files and the scene's saved views.
void readKeptLists(const Document& document, ViewState& state) {
    const std::filesystem::path& scene = state.options.scene;
    try {
        if (!scene.empty() && document.remembersFiles) rememberRecentFile(recentFilesPath(), scene);
    } catch (const Error& error) {
        sayFault(state, fmt::format("cannot save the list of recent files: {}", error.what()));
    }
    state.recent = readRecentFiles(recentFilesPath());
    try {
        state.savedViews = readSavedViews(savedViewsPath(), savedViewsKey(scene));
    } catch (const Error& error) {
        sayFault(state, error.what());
    }
}

void sayNotes(const PreparedFrame& frame, ViewState& state) {
    if (frame.scaleNote) say(state, *frame.scaleNote);
    for (const std::string& line : frame.refusedLensValues)
        sayFault(state, fmt::format("camera '{}': {}; the value is ignored", frame.cameraName, line));
}

void sayCacheFailure(const PreparedFrame& frame, ViewState& state) {
    if (!frame.cacheFailure.empty()) sayFault(state, "simplified meshes are not cached: " + frame.cacheFailure);
}

// Replaces the scene, and resets the state that belongs to the previous scene.
void adoptScene(Document& document, ViewState& state, LoadedScene scene) {
    document.frame = std::move(scene.frame);
    document.draft = scene.draft;
    document.shown = scene.options;
    document.poseIsStale = false;
    PreparedFrame& frame = *document.frame;
    document.shutterCameras = frame.view.shutterCameras;
    document.ownBlurs.clear();
    for (const Node& node : frame.scene->nodes) document.ownBlurs.push_back(node.cocScale);
    ++document.worldVersion;

    state.options = scene.options;
    state.environmentPath = scene.options.environment.string();
    state.aperturePath = scene.options.lens.apertureImage.string();
    static_cast<SceneState&>(state) = {};
    state.lens = frame.view.lens;
    state.camera.worldFromCamera = frame.view.worldFromCamera;
    const Bounds& bounds = frame.world.pose.bounds;
    const double depth =
        bounds.empty() ? 0 : -(glm::inverse(frame.view.worldFromCamera) * glm::dvec4(bounds.centre(), 1)).z;
    state.camera.pivotDistance = depth > 0 ? depth : std::min(state.lens.focusDistance, 1e6);
    state.followsCamera = !scene.options.cameraPosition && !scene.options.cameraTarget && !scene.options.cameraUp;
    state.nearPlane = wanderingNearPlane(frame.view.nearPlane, bounds);
    state.exposure = metersExposure(scene.options, *frame.scene, state.lens)
                         ? meteredExposure(frame.world, frame.view, frame.settings, document.shaderFolder)
                         : exposureOf(scene.options).value_or(state.exposure);
    state.meters = std::holds_alternative<MeteredExposure>(scene.options.exposure);
    sayNotes(frame, state);
    sayCacheFailure(frame, state);
    readKeptLists(document, state);
    document.history.begin(state);
}

void stepThroughHistory(Document& document, ViewState& state, const ViewActions& actions) {
    // Finish a running focus pull at once, by setting its end distance.
    if (state.pull) state.lens.focusDistance = state.pull->to;
    state.pull.reset();
    EditHistory& history = document.history;
    const std::optional<ViewEdit> edit = actions.undo   ? history.undo(state)
                                         : actions.redo ? history.redo(state)
                                                        : history.reset(state);
    if (!edit) return say(state, actions.redo ? "Nothing to redo." : "Nothing to undo.");
    const double time = state.options.time;
    const std::string clip = state.options.clip;
    static_cast<ViewEdit&>(state) = *edit;
    state.options.time = time;
    state.options.clip = clip;
    // The restored lens contains its aperture image, so the image need not be loaded again.
    document.shown.lens.apertureImage = state.options.lens.apertureImage;
    document.poseIsStale = !document.frame->scene->clips.empty();  // an animated camera must be posed again
    state.aperturePath = state.options.lens.apertureImage.string();
    state.marker.shown = false;
    state.focusPoints.clear();
}

// Saves the current view, or restores or deletes a saved view. Throws Error if the file of saved views can't be read or
// written.
void actOnSavedViews(ViewState& state, const ViewActions& actions) {
    std::vector<SavedView> views = state.savedViews;
    if (actions.saveView) {
        auto place = std::ranges::find(views, *actions.saveView, &SavedView::name);
        if (place == views.end()) place = views.emplace(place);
        *place = {*actions.saveView, state.camera, state.nearPlane, state.lens};
    }
    if (actions.deleteView && *actions.deleteView < views.size())
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*actions.deleteView));
    if (actions.saveView || actions.deleteView) {
        writeSavedViews(savedViewsPath(), savedViewsKey(state.options.scene), views);
        state.savedViews = std::move(views);
    }
    if (actions.saveView) {
        say(state, fmt::format("View '{}' saved.", *actions.saveView));
        state.viewName.clear();
    }
    if (!actions.goToView || *actions.goToView >= state.savedViews.size()) return;
    const SavedView& view = state.savedViews[*actions.goToView];
    const std::shared_ptr<const Image> aperture = state.lens.apertureImage;
    state.camera = view.camera;
    state.nearPlane = view.nearPlane;
    state.lens = view.lens;
    state.lens.apertureImage = aperture;
    state.followsCamera = false;
    state.pull.reset();
    state.marker.shown = false;
}

}  // namespace

void openScene(Document& document, const ViewState& state, const std::filesystem::path& scene) {
    Request options = withoutScene(state.options);
    options.scene = scene;
    document.loader.open(options);
}

bool takeLoadedScene(Document& document, ViewState& state) {
    std::optional<LoadedScene> loaded = document.loader.take();
    if (!loaded) return false;
    if (!loaded->frame) {
        sayFault(state, loaded->fault);
        return false;
    }
    if (!document.frame || document.frame->scene != loaded->frame->scene) {
        adoptScene(document, state, std::move(*loaded));
        return true;
    }
    // Replace the draft pyramids with the final ones; camera, lens and all edits stay.
    document.frame->world.pyramids = std::move(loaded->frame->world.pyramids);
    document.draft = false;
    ++document.worldVersion;
    sayCacheFailure(*loaded->frame, state);
    return false;
}

View currentView(const Document& document, const ViewState& state) {
    View view;
    view.worldFromCamera = state.camera.worldFromCamera;
    view.lens = state.lens;
    view.nearPlane = state.nearPlane;
    view.width = state.pictureSize.x;
    view.height = state.pictureSize.y;
    if (state.followsCamera) view.shutterCameras = document.shutterCameras;
    return view;
}

void noteEdit(Document& document, const ViewState& state, bool held) {
    document.history.note(state, held || state.pull || state.poppingSince, state.now);
}

void actOnDocument(Document& document, ViewState& state, const ViewActions& actions, bool exporting) {
    if (actions.open) openScene(document, state, *actions.open);
    if (!document.frame) return;
    if (actions.undo || actions.redo || actions.resetAll) {
        if (exporting)
            say(state, "Undo is available after the still is written.");
        else
            stepThroughHistory(document, state, actions);
    }
    actOnSavedViews(state, actions);
    if (actions.chooseCamera) switchCamera(document, state, *actions.chooseCamera);
}

}  // namespace defocus::engine
