// What people ask a view for, once: files to open and to write, the clipboard, the state as JSON.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "core/stopwatch.h"
#include "frame/focus.h"
#include "frame/render_command_text.h"
#include "view/recent_files.h"
#include "view/session.h"

namespace defocus {

namespace {

constexpr double statsEvery = 0.2;  // s
constexpr double exportSlice = 60;  // ms a frame

// What another scene keeps of the options: samples, levels, method, surroundings.
Request withoutScene(Request options) {
    const Request standard;
    options.time = standard.time;
    options.clip = standard.clip;
    options.camera = standard.camera;
    options.cameraPosition = options.cameraTarget = options.cameraUp = std::nullopt;
    options.lens = standard.lens;
    options.focusNode = standard.focusNode;
    options.focusPixel = standard.focusPixel;
    options.focusPoints = standard.focusPoints;
    options.focusAuto = standard.focusAuto;
    options.nodeBlur = standard.nodeBlur;
    options.hidden = standard.hidden;
    return options;
}

nlohmann::ordered_json placesJson(const std::map<std::string, ImVec2>& places) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, at] : places) json[name] = {std::lround(at.x), std::lround(at.y)};
    return json;
}

}  // namespace

void ViewSession::act() {
    const ViewActions actions = std::exchange(actions_, {});
    try {
        if (actions.open) open(*actions.open);
        if (actions.openDialog) openDialog();
        if (actions.toggleFullscreen) window_.setFullscreen(!window_.fullscreen());
        if (frame_) stepInHistory(actions);
        if (frame_) keepViews(actions);
        if (actions.chooseCamera) chooseCamera(*actions.chooseCamera);
        if (actions.changed && frame_ && !export_) change(*actions.changed);
        if (actions.frameSelection || actions.frameAll) frameBounds(actions.frameSelection);
        if (actions.togglePopping && picture_)
            state_.poppingSince = state_.poppingSince ? std::nullopt : std::optional(now());
        if (actions.focusThroughPoints) tiltFocus();
        if (frame_) share(actions);
        if (actions.quit) window_.close();
    } catch (const Error& error) {
        say(error.what(), true);
    }
}

void ViewSession::open(const std::filesystem::path& scene) {
    Request options = withoutScene(state_.options);
    options.scene = scene;
    loader_.open(options);
}

// The desktop's dialog where it has one, else the window's own.
void ViewSession::openDialog() {
    if (desktopDialog_.running() || dialogOpen()) return;
    state_.recent = readRecentFiles(recentFilesPath());
    if (!desktopDialog_.open(openFolder())) browser_.open(openFolder(), state_.recent);
}

// Where the dialog begins: beside the scene that is shown.
std::filesystem::path ViewSession::openFolder() const {
    const std::filesystem::path& scene = state_.options.scene;
    std::error_code ignored;
    return scene.empty() ? std::filesystem::current_path(ignored) : std::filesystem::absolute(scene).parent_path();
}

void ViewSession::finishDialogs(const std::optional<std::filesystem::path>& browsed) {
    if (browsed) actions_.open = browsed;
    const std::optional<DesktopDialog::Outcome> outcome = desktopDialog_.take();
    if (outcome && !outcome->chosen.empty()) actions_.open = outcome->chosen;
    if (outcome && outcome->failed && !dialogOpen()) browser_.open(openFolder(), state_.recent);
}

// Views that are kept by name: saved, gone to, forgotten.
void ViewSession::keepViews(const ViewActions& actions) {
    std::vector<SavedView> views = state_.savedViews;
    if (actions.saveView) {
        const SavedView view{*actions.saveView, state_.camera, state_.nearPlane, state_.lens};
        const auto same = std::ranges::find(views, view.name, &SavedView::name);
        if (same == views.end())
            views.push_back(view);
        else
            *same = view;
        state_.viewName.clear();
        say(fmt::format("The view '{}' is kept.", view.name));
    }
    if (actions.forgetView && *actions.forgetView < views.size())
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*actions.forgetView));
    if (actions.saveView || actions.forgetView) {
        writeSavedViews(savedViewsPath(), savedViewsKey(state_.options.scene), views);
        state_.savedViews = std::move(views);
    }
    if (!actions.goToView || *actions.goToView >= state_.savedViews.size()) return;
    const SavedView& view = state_.savedViews[*actions.goToView];
    const std::shared_ptr<const Image> aperture = state_.lens.apertureImage;
    state_.camera = view.camera;
    state_.nearPlane = view.nearPlane;
    state_.lens = view.lens;
    state_.lens.apertureImage = aperture;
    state_.followsCamera = false;
    state_.pull.reset();
    state_.marker.shown = false;
}

void ViewSession::tiltFocus() {
    const glm::dmat4 viewFromWorld = glm::inverse(state_.camera.worldFromCamera);
    std::array<glm::dvec3, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = viewFromWorld * glm::dvec4(state_.focusPoints.at(i), 1);
    state_.focusPoints.clear();
    Lens lens = state_.lens;
    focusThrough(points, lens, "focus plane");
    checkLens(lens);
    state_.lens = lens;
    state_.pull.reset();
    say("The focus plane goes through the three points.");
}

// What leaves the window.
void ViewSession::share(const ViewActions& actions) {
    if (actions.copyCommand) {
        window_.setClipboard(command());
        say("The command is on the clipboard.");
    }
    if (actions.recordKey) {
        state_.shotKeys.push_back({exportView(), state_.camera.pivotDistance, state_.animation.time});
        say(fmt::format("Key {} is recorded; save the shot in the panel's Export.", state_.shotKeys.size()));
    }
    if (actions.saveShot && !state_.shotKeys.empty()) {
        writeFile(state_.shotPath, shotJson({state_.options, frame_->cameraLens, state_.shotKeys,
                                             state_.animation.speed, writeOptions(), frame_->scene->metresPerUnit}));
        const std::string command = captureCommand(state_.shotPath, state_.options);
        window_.setClipboard(command);
        say(fmt::format("Written: {}; film it with (on the clipboard): {}", state_.shotPath, command));
    }
    if (actions.cancelExport && export_) {
        export_.reset();
        say("The export was stopped; nothing was written.");
    }
    if (actions.askExport && export_) say("A still is being written; Esc cancels it.");
    if (actions.askExport && !export_ && !dialogOpen()) state_.exportDialog.emplace();
    if (actions.exportStill && !export_) beginExport();
}

// What `render` would have to be asked for.
std::string ViewSession::command() const {
    const View view = exportView();
    return renderCommand(
        {state_.options, *frame_, view, state_.camera.pivotDistance, writeOptions(), state_.exportPath});
}

View ViewSession::exportView() const {
    View view = currentView();
    const glm::ivec2 size = state_.exportSize.value_or(glm::ivec2(view.width, view.height));
    view.width = size.x;
    view.height = size.y;
    return view;
}

WriteOptions ViewSession::writeOptions() const {
    return {state_.display.toneMap, shownExposure(state_)};
}

void ViewSession::beginExport() {
    if (draft_) {
        say("A still waits for the simplified meshes: try again in a moment", true);
        return;
    }
    state_.animation.playing = false;
    StillRequest still;
    still.options = state_.options;
    still.view = exportView();
    still.output = state_.exportPath;
    still.write = writeOptions();
    still.software = window_.software();
    still.shaderFolder = shaderFolder_;
    export_.emplace(*frame_, still);
}

void ViewSession::exportStep() {
    if (!export_) return;
    try {
        const Clock::time_point begin = Clock::now();
        bool more = true;
        while (more && millisecondsSince(begin) < exportSlice) more = export_->step();
        if (more) return;
        say("Written: " + export_->request().output.string());
    } catch (const Error& error) {
        say(error.what(), true);
    }
    export_.reset();
}

void ViewSession::takeScreenshot(const std::filesystem::path& path) {
    std::filesystem::path chosen = path;
    for (int i = 1; chosen.empty() || (path.empty() && std::filesystem::exists(chosen)); ++i)
        chosen = fmt::format("defocus-view-{:03}.png", i);
    try {
        writeImage(chosen, window_.pixels());
    } catch (const Error& error) {
        if (!path.empty()) throw;
        say(error.what(), true);
        return;
    }
    if (path.empty()) say("Written: " + chosen.string());
}

void ViewSession::say(std::string text, bool fault) {
    if (fault) fault_ = text;
    if (fault && !quiet_ && options_.frames == 0) printMessage("defocus: {}\n", text);
    state_.messages.push_back({std::move(text), fault, now() + (fault ? 9.0 : 3.0)});
    if (state_.messages.size() > 4) state_.messages.pop_front();
}

void ViewSession::writeStats() {
    if (options_.stats.empty() || (statsWrittenAt_ >= 0 && now() - statsWrittenAt_ < statsEvery)) return;
    statsWrittenAt_ = now();
    const PictureArea picture = area();
    const glm::dvec3 position = state_.camera.position();
    const FocusMarker& marker = state_.marker;
    nlohmann::ordered_json passes = {{"interface", interfaceMilliseconds_}};
    if (picture_)
        for (const PassShare& pass : picture_->passes()) passes[pass.name] = pass.milliseconds;
    const InputLatency::Summary latency = latency_.summary();
    using json = nlohmann::ordered_json;
    static const FramePlan nothing;
    const FramePlan& plan = picture_ ? picture_->plan() : nothing;
    json stats = {
        {"scene", frame_ ? frame_->sceneName : ""},
        {"loading", loader_.busy()},
        {"draft", draft_},
        {"fault", fault_},
        {"frames", framesDrawn_},  // with all events that came before the frame before the last
        {"typing", inputContext().typing},
        {"openPath", state_.openPath},
        {"samples", picture_ ? picture_->samples() : 0},
        {"converged", picture_ && picture_->converged()},
        {"moving", picture_ && picture_->moving()},
        {"changes", picture_ ? picture_->changes() : 0},
        {"begun", picture_ ? picture_->begun() : 0},
        {"frameMilliseconds", frameMilliseconds_},
        {"passMilliseconds", passes},
        {"inputMilliseconds",
         {{"count", latency.count}, {"latest", latency.latest}, {"median", latency.median}, {"worst", latency.worst}}},
        {"budgetMilliseconds", state_.budget.milliseconds},
        {"quality", state_.budget.rung},
        {"picture", {picture.origin.x, picture.origin.y, picture.size.x, picture.size.y}},
        {"scale", scale()},
        {"cameraPosition", {position.x, position.y, position.z}},
        {"focusDistance",
         std::isfinite(state_.lens.focusDistance) ? nlohmann::ordered_json(state_.lens.focusDistance) : nullptr},
        {"focusTilt", state_.lens.focusTilt},
        {"focusSwing", state_.lens.focusSwing},
        {"fStop", state_.lens.fStop},
        {"focalLength", state_.lens.focalLength},
        {"selected", frame_ && state_.selected >= 0
                         ? frame_->world.pose.objects[static_cast<std::size_t>(state_.selected)].name
                         : ""},
        {"time", state_.animation.time},
        {"playing", state_.animation.playing},
        {"overlay", static_cast<int>(state_.display.overlay)},
        {"workSamples", picture_ ? picture_->workSamples() : 0},
        {"comparison", static_cast<int>(state_.comparison)},
        {"divider", state_.display.divider},
        {"psnr", picture_ && picture_->psnr() && std::isfinite(*picture_->psnr())
                     ? nlohmann::ordered_json(*picture_->psnr())
                     : nullptr},
        {"warnings", warnings_},
        {"drawn", {plan.view.width, plan.view.height, plan.samples.size()}},
        {"marker",
         {{"shown", marker.shown}, {"number", marker.number}, {"name", marker.name}, {"distance", marker.distance}}},
        {"undoSteps", history_.undoSteps()},
        {"redoSteps", history_.redoSteps()},
        {"exposure", shownExposure(state_)},
        {"hidden", state_.options.hidden},
        {"objects", frame_ ? frame_->world.pose.objects.size() : 0},
        {"views", state_.savedViews.size()},
        {"fullscreen", window_.fullscreen()},
        {"dialog", browser_.opened()                    ? "open"
                   : desktopDialog_.running()           ? "desktop"
                   : !state_.exportDialog               ? ""
                   : state_.exportDialog->asksToReplace ? "replace"
                                                        : "export"},
        {"exportPath", state_.exportPath},
        {"exportShare", export_ ? export_->share() : 0},
        {"places", placesJson(places_)},  // of widgets, to click on
        {"dark", state_.dark},
        {"help", state_.help},
        {"poppingTest", state_.poppingSince.has_value()},
        {"shotKeys", state_.shotKeys.size()},
        {"exporting", export_.has_value()},
        {"wave", picture_ ? picture_->wave() : 0},
        {"command", frame_ ? command() : ""},  // what is copied by hand
        {"device", window_.device()},
    };
    writeFile(options_.stats, stats.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace defocus
