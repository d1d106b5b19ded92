#include "app/view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/render_command_text.h"
#include "core/error.h"
#include "core/file.h"
#include "eval/reference_image.h"

namespace defocus {

namespace {

constexpr double softwareBudget = 66;  // ms, where the CPU draws
constexpr std::size_t shownFrameTimes = 120;
constexpr double poppingDuration = 8;  // s, from near to far and back
constexpr double statsEvery = 0.2;     // s
constexpr double exportSlice = 60;     // ms a frame

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

WindowOptions windowOptions(const SessionOptions& options, const ViewSettings& settings) {
    WindowOptions window;
    const SceneOptions standard;
    const bool asked = options.scene.width != standard.width || options.scene.height != standard.height;
    const bool remembered = settings.width > 0 && settings.height > 0 && !asked && options.frames == 0;
    window.width = remembered ? settings.width
                              : options.scene.width +
                                    (settings.panel ? static_cast<int>(panelWidth * settings.interfaceScale) : 0);
    window.height = remembered ? settings.height : options.scene.height;
    return window;
}

ViewSettings rememberedSettings() {
    try {
        return readViewSettings(viewSettingsPath());
    } catch (const Error& error) {
        fmt::print(stderr, "warning: {}\n", error.what());
        return {};
    }
}

}  // namespace

ViewSession::ViewSession(const SessionOptions& options, const GlobalOptions& global)
    : options_(options),
      shaderFolder_(global.shaderDir),
      quiet_(global.quiet),
      settings_(rememberedSettings()),
      window_(windowOptions(options, settings_)),
      interface_(window_) {
    state_.options = options.scene;
    state_.dark = settings_.dark;
    state_.panel = settings_.panel;
    state_.interfaceScale = settings_.interfaceScale;
    state_.budget.milliseconds =
        settings_.budgetMilliseconds.value_or(window_.software() ? softwareBudget : state_.budget.milliseconds);
    if (window_.software()) state_.budget.rung = 1;
    loader_.open(options.scene);
}

ViewSession::~ViewSession() {
    try {
        settings_.dark = state_.dark;
        settings_.panel = state_.panel;
        settings_.interfaceScale = state_.interfaceScale;
        settings_.budgetMilliseconds = state_.budget.milliseconds;
        if (options_.frames == 0) {
            settings_.width = window_.size().x;
            settings_.height = window_.size().y;
        }
        writeViewSettings(viewSettingsPath(), settings_);
    } catch (const std::exception& error) {
        if (!quiet_) fmt::print(stderr, "warning: settings are not kept: {}\n", error.what());
    }
}

void ViewSession::run() {
    while (!window_.closing()) {
        frame();
        if (options_.frames > 0 && !fault_.empty() && !frame_ && !loader_.busy()) throw Error(fault_);
        if (options_.frames > 0 && framesWithScene_ >= options_.frames) break;
    }
    statsWrittenAt_ = -1;
    writeStats();
}

// ---- a frame ------------------------------------------------------------------------------------

void ViewSession::frame() {
    const std::vector<WindowEvent> events = window_.poll(waitingTime());
    const glm::ivec2 framebuffer = window_.framebufferSize();
    if (framebuffer.x < 1 || framebuffer.y < 1) {  // minimised
        takeScene();
        window_.poll(0.05);
        return;
    }
    const Clock::time_point begin = Clock::now();
    const double time = now();
    const double elapsed = time - std::exchange(lastFrame_, time);
    interface_.beginFrame(state_.dark, scale());
    takeScene();
    handleEvents(events);
    moveThings(elapsed);
    updatePicture();
    exportStep();

    const Clock::time_point interfaceBegin = Clock::now();
    window_.beginFrame(windowColor(state_.dark));
    drawInterface();
    interface_.endFrame();
    const bool last = options_.frames > 0 && picture_ && framesWithScene_ + 1 == options_.frames;
    if (last && !options_.screenshot.empty()) takeScreenshot(options_.screenshot);
    if (actions_.screenshot) takeScreenshot({});
    window_.endFrame();
    interfaceMilliseconds_ = millisecondsSince(interfaceBegin);
    act();
    if (picture_) ++framesWithScene_;
    frameMilliseconds_ = millisecondsSince(begin);
    frameTimes_.push_back(static_cast<float>(frameMilliseconds_));
    if (frameTimes_.size() > shownFrameTimes) frameTimes_.erase(frameTimes_.begin());
    writeStats();
}

// Nothing moves and nothing grows: sleep until something happens.
double ViewSession::waitingTime() const {
    if (loader_.busy()) return 0.03;
    if (!picture_) return 0.1;
    if (export_ || state_.animation.playing || state_.pull || state_.poppingSince || !picture_->finished() ||
        options_.frames > 0)
        return 0;
    return state_.messages.empty() ? 0.25 : 0.1;
}

void ViewSession::handleEvents(const std::vector<WindowEvent>& events) {
    const InputContext context = inputContext();
    for (const WindowEvent& event : events) input_.handle(event, context, state_, actions_);
}

InputContext ViewSession::inputContext() const {
    const ImGuiIO& io = ImGui::GetIO();
    return {area(), frame_.get(), io.WantCaptureMouse, io.WantTextInput, io.NavVisible && io.NavActive, now()};
}

// ---- the scene ----------------------------------------------------------------------------------

void ViewSession::takeScene() {
    std::optional<LoadedScene> loaded = loader_.take();
    if (!loaded) return;
    if (loaded->frame) {
        adoptScene(std::move(*loaded));
        return;
    }
    say(loaded->fault, true);
}

void ViewSession::adoptScene(LoadedScene scene) {
    export_.reset();
    picture_.reset();
    frame_ = std::move(scene.frame);
    state_.options = scene.options;
    state_.animation = {.clip = 0, .time = scene.options.time, .speed = state_.animation.speed, .playing = false};
    posedTime_ = state_.animation.time;
    posedClip_ = 0;
    state_.selected = -1;
    state_.poppingSince.reset();
    state_.lens = frame_->view.lens;
    state_.pull.reset();
    state_.camera.worldFromCamera = frame_->view.worldFromCamera;
    const Bounds& bounds = frame_->world.pose.bounds;
    const double depth =
        bounds.empty() ? 0 : -(glm::inverse(frame_->view.worldFromCamera) * glm::dvec4(bounds.centre(), 1)).z;
    state_.camera.pivotDistance = depth > 0 ? depth : std::min(state_.lens.focusDistance, 1e6);
    state_.followsCamera = !scene.options.cameraPosition && !scene.options.cameraTarget;
    state_.nearPlane = wanderingNearPlane(frame_->view.nearPlane, bounds);
    for (const std::string& line : frame_->refusedLensValues)
        say(fmt::format("camera '{}': {}; not used", frame_->cameraName, line), true);
    if (!frame_->cacheFailure.empty()) say("simplified meshes are not kept: " + frame_->cacheFailure, true);
    makePicture();
    window_.setTitle(frame_->sceneName + " – defocus");
}

void ViewSession::moveThings(double seconds) {
    if (!frame_) return;
    const InputContext context = inputContext();
    input_.fly(window_, context, seconds, state_);
    if (state_.pull) {
        state_.lens.focusDistance = state_.pull->distanceAt(now());
        if (state_.pull->over(now())) state_.pull.reset();
    }
    if (state_.poppingSince && now() - *state_.poppingSince > poppingDuration) actions_.togglePopping = true;

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
    if (animation.time != posedTime_ || animation.clip != posedClip_) poseScene();
}

void ViewSession::poseScene() {
    if (export_) return;  // the still that is being rendered stands
    const AnimationState& animation = state_.animation;
    World& world = frame_->world;
    world.pose = poseAt(*frame_->scene, animation.time, animation.clip);
    if (!world.pose.lights.empty()) world.lights = world.pose.lights;
    if (state_.followsCamera) {
        const glm::ivec2 size = pictureSize();
        const PlacedCamera placed = defocus::chooseCamera(*frame_->scene, world.pose, state_.options.camera,
                                                          static_cast<double>(size.x) / size.y);
        if (placed.camera.name != "auto") state_.camera.worldFromCamera = placed.worldFromCamera;
    }
    posedTime_ = animation.time;
    posedClip_ = animation.clip;
    state_.options.time = animation.time;
    ++poseVersion_;
}

void ViewSession::chooseCamera(const std::string& name) {
    if (!frame_) return;
    SceneOptions options = state_.options;
    options.camera = name;
    options.cameraPosition.reset();
    options.cameraTarget.reset();
    options.cameraUp.reset();
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

// ---- the picture --------------------------------------------------------------------------------

double ViewSession::now() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
}

double ViewSession::scale() const {
    // Quarters: fonts are made anew for each.
    return std::clamp(std::round(window_.contentScale() * state_.interfaceScale * 8) / 8, 0.5, 4.0);
}

PictureArea ViewSession::area() const {
    const glm::dvec2 size = window_.size();
    const double beside = state_.panel ? std::min(panelWidth * scale(), 0.6 * size.x) : 0;
    return {{0, 0}, glm::max(glm::dvec2(size.x - beside, size.y), glm::dvec2(1))};
}

glm::ivec2 ViewSession::pictureSize() const {
    const glm::dvec2 perUnit =
        glm::dvec2(window_.framebufferSize()) / glm::max(glm::dvec2(window_.size()), glm::dvec2(1));
    return glm::clamp(glm::ivec2(glm::round(area().size * perUnit)), glm::ivec2(1), glm::ivec2(16384));
}

View ViewSession::currentView() const {
    View view;
    view.worldFromCamera = state_.camera.worldFromCamera;
    view.lens = state_.lens;
    view.nearPlane = state_.nearPlane;
    const glm::ivec2 size = pictureSize();
    view.width = size.x;
    view.height = size.y;
    return view;
}

PictureRequest ViewSession::request() const {
    PictureRequest result;
    result.view = currentView();
    result.settings = chosenSettings(state_.options);
    result.thresholdsFollow = !state_.options.blurThreshold && !state_.options.sizeThreshold;
    result.poseVersion = poseVersion_;
    result.first = {chosenMethod(state_.options), state_.options.lod, 0};
    result.display = state_.display;
    result.mostSamples = state_.mostSamples;
    const MethodUse accumulation = parseMethodUse("accumulation");
    switch (state_.comparison) {
        case Comparison::none:
            break;
        case Comparison::fullDetail:
            result.second = {result.first.method, LodMode::off, 0};
            break;
        case Comparison::nearest:
            result.second = {result.first.method, LodMode::nearest, 0};
            break;
        case Comparison::reference:
            result.second = {accumulation, LodMode::off, referenceOffset};
            break;
        case Comparison::method:
            result.second = {parseMethodUse(state_.comparedMethod), state_.options.lod, 0};
            break;
    }
    if (state_.poppingSince) {
        // From the nearest to the farthest object and back, evenly in 1/distance.
        double nearest = 1e6;
        double farthest = 1e-3;
        for (const ObjectPlan& object : picture_->plan().objects) {
            nearest = std::min(nearest, std::max(object.nearestDepth, 2 * result.view.nearPlane));
            farthest = std::max(farthest, object.farthestDepth);
        }
        const double share = 0.5 - 0.5 * std::cos(2 * M_PI * (now() - *state_.poppingSince) / poppingDuration);
        result.view.lens.focusDistance = 1 / ((1 - share) / nearest + share / std::max(nearest, farthest));
        result.first = {accumulation, LodMode::fractional, 0};
        result.second = {accumulation, LodMode::nearest, 0};
        result.fixedQuality = FrameQuality{window_.software() ? 0.5 : 1.0, 16, 1};
    }
    return result;
}

void ViewSession::makePicture() {
    RendererOptions options;
    options.layerFormat = state_.options.layerFormat;
    options.shaderFolder = shaderFolder_;
    options.wave = window_.software() ? 1 : 8;
    picture_.emplace(frame_->world, options, window_.software());
}

void ViewSession::updatePicture() {
    if (!picture_) return;
    try {
        picture_->update(request(), state_.budget);
    } catch (const Error& error) {
        // A request that can't be drawn: back to what can.
        say(error.what(), true);
        if (state_.comparison != Comparison::none || state_.poppingSince) {
            state_.comparison = Comparison::none;
            state_.poppingSince.reset();
        } else if (state_.options.method != "accumulation") {
            state_.options.method = "accumulation";
            state_.options.methodSettings.clear();
        } else {
            throw;
        }
        makePicture();
        picture_->update(request(), state_.budget);
    }
}

std::string ViewSession::sideLabel(const PictureSide& side) const {
    if (side.firstSample == referenceOffset) return "reference";
    const std::string method = side.method.text();
    if (method != "accumulation") return method;
    return side.lod == LodMode::off ? "full detail" : std::string(lodModeName(side.lod)) + " levels";
}

void ViewSession::drawInterface() {
    const InterfaceColors colors = interfaceColors(state_.dark);
    const auto unit = static_cast<float>(scale());
    const PictureArea picture = area();
    const ImVec2 end(static_cast<float>(picture.size.x), static_cast<float>(picture.size.y));
    HudContext hud;
    if (picture_) {
        // Row 0 of the texture is the bottom one. ImGui names textures by pointers.
        const auto name = static_cast<std::uintptr_t>(picture_->texture().name());
        ImGui::GetBackgroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(name), {0, 0}, end, {0, 1}, {1, 0});
        const PictureRequest shown = request();
        if (shown.second) {
            hud.leftLabel = sideLabel(shown.first);
            hud.rightLabel = sideLabel(*shown.second);
        }
    }
    hud.area = picture;
    hud.frame = frame_.get();
    hud.picture = picture_ ? &*picture_ : nullptr;
    hud.loader = &loader_;
    hud.colors = colors;
    hud.scale = unit;
    hud.now = now();
    hud.frameMilliseconds = frameMilliseconds_;
    hud.mouseOnInterface = ImGui::GetIO().WantCaptureMouse;
    drawHud(hud, state_);
    if (!state_.panel) return;

    PanelContext panel;
    panel.frame = frame_.get();
    panel.picture = hud.picture;
    panel.colors = colors;
    panel.scale = unit;
    panel.origin = {end.x, 0};
    panel.size = {static_cast<float>(window_.size().x) - end.x, end.y};
    panel.frameMilliseconds = &frameTimes_;
    panel.interfaceMilliseconds = interfaceMilliseconds_;
    panel.exporting = export_.has_value();
    panel.exportShare = export_ ? export_->share() : 0;
    panel.pictureSize = pictureSize();
    panel.device = &window_.device();
    drawPanel(panel, state_, actions_);
}

// ---- what people asked for ----------------------------------------------------------------------

void ViewSession::act() {
    const ViewActions actions = std::exchange(actions_, {});
    try {
        if (actions.open) {
            SceneOptions options = state_.options;
            options.path = *actions.open;
            options.camera.clear();
            options.cameraPosition.reset();
            options.cameraTarget.reset();
            options.cameraUp.reset();
            options.focusNode.clear();
            options.focusPixel.reset();
            options.lens.clear();
            options.time = 0;
            loader_.open(options);
        }
        if (actions.chooseCamera) chooseCamera(*actions.chooseCamera);
        if (actions.frameSelection || actions.frameAll) frameBounds(actions.frameSelection);
        if (actions.togglePopping && picture_)
            state_.poppingSince = state_.poppingSince ? std::nullopt : std::optional(now());
        if (actions.copyCommand && frame_) {
            View view = currentView();
            const glm::ivec2 size = state_.exportSize.value_or(glm::ivec2(view.width, view.height));
            view.width = size.x;
            view.height = size.y;
            const RenderCommandText text{state_.options,
                                         *frame_,
                                         view,
                                         state_.camera.pivotDistance,
                                         {state_.display.toneMap, state_.display.exposure},
                                         state_.exportPath};
            window_.setClipboard(renderCommand(text));
            say("The command is on the clipboard.");
        }
        if (actions.cancelExport && export_) {
            export_.reset();
            say("The export was stopped; nothing was written.");
        }
        if (actions.exportStill && frame_ && !export_) beginExport();
        if (actions.quit) window_.close();
    } catch (const Error& error) {
        say(error.what(), true);
    }
}

void ViewSession::beginExport() {
    state_.animation.playing = false;
    StillRequest still;
    still.options = state_.options;
    still.view = currentView();
    const glm::ivec2 size = state_.exportSize.value_or(glm::ivec2(still.view.width, still.view.height));
    still.view.width = size.x;
    still.view.height = size.y;
    still.output = state_.exportPath;
    still.write = {state_.display.toneMap, state_.display.exposure};
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
    if (fault && !quiet_ && options_.frames == 0) fmt::print(stderr, "defocus: {}\n", text);
    state_.messages.push_back({std::move(text), fault, now() + (fault ? 9.0 : 3.0)});
    if (state_.messages.size() > 4) state_.messages.pop_front();
}

void ViewSession::writeStats() {
    if (options_.stats.empty() || (statsWrittenAt_ >= 0 && now() - statsWrittenAt_ < statsEvery)) return;
    statsWrittenAt_ = now();
    const PictureArea picture = area();
    const glm::dvec3 position = state_.camera.position();
    nlohmann::ordered_json json = {
        {"scene", frame_ ? frame_->sceneName : ""},
        {"loading", loader_.busy()},
        {"fault", fault_},
        {"samples", picture_ ? picture_->samples() : 0},
        {"moving", picture_ && picture_->moving()},
        {"changes", picture_ ? picture_->changes() : 0},
        {"frameMilliseconds", frameMilliseconds_},
        {"budgetMilliseconds", state_.budget.milliseconds},
        {"quality", state_.budget.rung},
        {"picture", {picture.origin.x, picture.origin.y, picture.size.x, picture.size.y}},
        {"cameraPosition", {position.x, position.y, position.z}},
        {"focusDistance",
         std::isfinite(state_.lens.focusDistance) ? nlohmann::ordered_json(state_.lens.focusDistance) : nullptr},
        {"fStop", state_.lens.fStop},
        {"focalLength", state_.lens.focalLength},
        {"selected", frame_ && state_.selected >= 0
                         ? frame_->world.pose.objects[static_cast<std::size_t>(state_.selected)].name
                         : ""},
        {"time", state_.animation.time},
        {"playing", state_.animation.playing},
        {"comparison", static_cast<int>(state_.comparison)},
        {"divider", state_.display.divider},
        {"psnr", picture_ && picture_->psnr() && std::isfinite(*picture_->psnr())
                     ? nlohmann::ordered_json(*picture_->psnr())
                     : nullptr},
        {"dark", state_.dark},
        {"help", state_.help},
        {"poppingTest", state_.poppingSince.has_value()},
        {"exporting", export_.has_value()},
        {"device", window_.device()},
    };
    writeFile(options_.stats, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace defocus
