#include "view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/error.h"
#include "core/message.h"
#include "core/stopwatch.h"
#include "view/export_panel.h"
#include "view/recent_files.h"

namespace defocus {

namespace {

constexpr double softwareBudget = 50;  // ms, where the CPU draws
constexpr std::size_t shownFrameTimes = 120;

WindowOptions windowOptions(const SessionOptions& options, const ViewSettings& settings) {
    WindowOptions window;
    const Request standard;
    const bool asked = options.request.width != standard.width || options.request.height != standard.height;
    const bool remembered = settings.width > 0 && settings.height > 0 && !asked && options.frames == 0;
    window.width = remembered ? settings.width
                              : options.request.width +
                                    (settings.panel ? static_cast<int>(panelWidth * settings.interfaceScale) : 0);
    window.height = remembered ? settings.height : options.request.height;
    return window;
}

ViewSettings rememberedSettings() {
    try {
        return readViewSettings(viewSettingsPath());
    } catch (const Error& error) {
        printMessage("warning: {}\n", error.what());
        return {};
    }
}

}  // namespace

ViewSession::ViewSession(const SessionOptions& options)
    : options_(options),
      shaderFolder_(options.shaderFolder),
      quiet_(options.quiet),
      settings_(rememberedSettings()),
      window_(windowOptions(options, settings_)),
      interface_(window_) {
    state_.options = options.request;
    state_.display.toneMap = options.request.toneMap;
    state_.display.exposure = options.request.exposure.value_or(0);
    state_.dark = settings_.dark;
    state_.panel = settings_.panel;
    state_.interfaceScale = settings_.interfaceScale;
    state_.budget.milliseconds =
        settings_.budgetMilliseconds.value_or(window_.software() ? softwareBudget : state_.budget.milliseconds);
    if (window_.software()) state_.budget.rung = 2;
    state_.recent = readRecentFiles(recentFilesPath());
    loader_.open(options.request);
}

ViewSession::~ViewSession() {
    try {
        settings_.dark = state_.dark;
        settings_.panel = state_.panel;
        settings_.interfaceScale = state_.interfaceScale;
        settings_.budgetMilliseconds = state_.budget.milliseconds;
        if (options_.frames == 0 && !window_.fullscreen()) {
            const glm::dvec2 size = glm::dvec2(window_.size()) / window_.contentScale();
            settings_.width = static_cast<int>(std::lround(size.x));
            settings_.height = static_cast<int>(std::lround(size.y));
        }
        writeViewSettings(viewSettingsPath(), settings_);
    } catch (const std::exception& error) {
        if (!quiet_) printMessage("warning: settings are not kept: {}\n", error.what());
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
    places_ = takePlaces();
    const std::vector<WindowEvent> events = fetchEvents();
    const glm::ivec2 framebuffer = window_.framebufferSize();
    if (framebuffer.x < 1 || framebuffer.y < 1) {  // minimised
        takeScene();
        window_.poll(0.05);
        return;
    }
    const Clock::time_point begin = Clock::now();
    const double time = now();
    const double elapsed = time - std::exchange(lastFrame_, time);
    interface_.beginFrame(state_.dark, scale(), events);
    takeScene();
    const std::uint64_t changesBefore = picture_ ? picture_->changes() : 0;
    handleEvents(events);
    moveThings(elapsed);
    noteEdits();
    updatePicture();
    meter();
    updateWarnings();
    exportStep();

    const Clock::time_point interfaceBegin = Clock::now();
    window_.beginFrame(windowColor(state_.dark));
    drawInterface();
    interface_.endFrame();
    const bool last = options_.frames > 0 && picture_ && !draft_ && framesWithScene_ + 1 == options_.frames;
    if (last && !options_.screenshot.empty()) takeScreenshot(options_.screenshot);
    if (actions_.screenshot) takeScreenshot({});
    window_.endFrame();
    noteLatency(changesBefore);
    interfaceMilliseconds_ = millisecondsSince(interfaceBegin);
    act();
    if (picture_ && !draft_) ++framesWithScene_;
    ++framesDrawn_;
    frameMilliseconds_ = growthMilliseconds_ + millisecondsSince(begin);
    frameTimes_.push_back(static_cast<float>(frameMilliseconds_));
    if (frameTimes_.size() > shownFrameTimes) frameTimes_.erase(frameTimes_.begin());
    writeStats();
}

// What has happened and goes into this frame; sleeps until something does where there is nothing to do.
std::vector<WindowEvent> ViewSession::fetchEvents() {
    const auto fetch = [&](double seconds) {
        for (WindowEvent& event : window_.poll(seconds)) events_.push_back(std::move(event));
    };
    // They may have come at once after the fetch before; those that had to wait came before that.
    Clock::time_point earliest = events_.empty() ? fetchedAt_ : queuedSince_;
    fetch(0);
    growthMilliseconds_ = 0;
    if (events_.empty() && picture_ && window_.framebufferSize().x > 0) {
        const Clock::time_point before = Clock::now();
        picture_->grow(state_.budget);
        growthMilliseconds_ = millisecondsSince(before);
        fetch(0);
        if (!events_.empty()) earliest = before;
    }
    if (const double seconds = waitingTime(); events_.empty() && seconds > 0) {
        fetch(seconds);
        earliest = Clock::now();
    }
    fetchedAt_ = Clock::now();
    if (events_.empty()) return {};
    queuedSince_ = earliest;
    latency_.arrived(earliest);
    const ImGuiIO& io = ImGui::GetIO();
    const PictureArea picture = area();
    const bool interfaceHasHand = framesDrawn_ > 0 && (io.WantCaptureMouse || io.WantTextInput || dialogOpen());
    return takeEvents(events_, {interfaceHasHand, picture.origin + picture.size});
}

bool ViewSession::dialogOpen() const {
    return browser_.opened() || state_.exportDialog.has_value();
}

void ViewSession::noteLatency(std::uint64_t changesBefore) {
    if (picture_ && picture_->changes() > changesBefore)
        latency_.shown(Clock::now());
    else if (!state_.pull)  // whose first step comes with the next frame
        latency_.forget();
}

// Nothing moves and nothing grows: sleep until something happens.
double ViewSession::waitingTime() const {
    if (!picture_) return loader_.busy() ? 0.03 : 0.1;
    if (export_ || state_.animation.playing || state_.pull || state_.poppingSince || !picture_->finished() ||
        options_.frames > 0)
        return 0;
    if (loader_.busy() || state_.marker.shown) return 0.03;
    return state_.messages.empty() && !desktopDialog_.running() ? 0.25 : 0.1;
}

void ViewSession::handleEvents(const std::vector<WindowEvent>& events) {
    const InputContext context = inputContext();
    for (const WindowEvent& event : events) input_.handle(event, context, state_, actions_);
}

InputContext ViewSession::inputContext() const {
    const ImGuiIO& io = ImGui::GetIO();
    const bool keysTaken = io.WantTextInput || dialogOpen();
    return {area(), frame_.get(), io.WantCaptureMouse, keysTaken, io.NavVisible && io.NavActive, now()};
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
    if (state_.followsCamera) view.shutterCameras = shutterCameras_;
    return view;
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
    hud.exporting = export_ ? &*export_ : nullptr;
    hud.warnings = warnings_;
    drawHud(hud, state_);

    PanelContext panel;
    panel.frame = frame_.get();
    panel.picture = hud.picture;
    panel.colors = colors;
    panel.scale = unit;
    panel.origin = {end.x, 0};
    panel.size = {static_cast<float>(window_.size().x) - end.x, end.y};
    panel.frameMilliseconds = &frameTimes_;
    panel.interfaceMilliseconds = interfaceMilliseconds_;
    panel.latency = latency_.summary();
    panel.undoSteps = history_.undoSteps();
    panel.redoSteps = history_.redoSteps();
    panel.exporting = export_.has_value();
    panel.exportShare = export_ ? export_->share() : 0;
    panel.pictureSize = pictureSize();
    panel.device = &window_.device();
    if (state_.panel) drawPanel(panel, state_, actions_);
    drawExportDialog(panel, state_, actions_);
    finishDialogs(browser_.draw(unit));
}

}  // namespace defocus
