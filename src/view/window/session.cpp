#include "view/window/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/message.h"
#include "frame/setup/exposure.h"
#include "view/hud/hud.h"
#include "view/panels/panels.h"

namespace defocus::engine {

namespace {

constexpr std::size_t shownFrameTimes = 120;

ViewSettings rememberedSettings() {
    try {
        return readViewSettings(viewSettingsPath());
    } catch (const Error& error) {
        printMessage("warning: {}\n", error.what());
        return {};
    }
}

WindowOptions windowOptions(const SessionOptions& options, const ViewSettings& settings) {
    const bool sizeGiven = options.request.size != ImageSize{};
    WindowOptions window;
    if (settings.width > 0 && settings.height > 0 && !sizeGiven && options.frames == 0) {
        window.width = settings.width;
        window.height = settings.height;
        return window;
    }
    const double panel = settings.panel ? panelWidth * settings.interfaceScale : 0;
    window.width = options.request.size.width + static_cast<int>(panel);
    window.height = options.request.size.height;
    return window;
}

void rememberSettings(Session& session) {
    const ViewState& state = session.state;
    ViewSettings& settings = session.settings;
    settings.dark = state.dark;
    settings.panel = state.panel;
    settings.interfaceScale = state.interfaceScale;
    settings.budgetMilliseconds = state.budget.milliseconds;
    if (session.options.frames == 0 && !session.window.fullscreen()) {
        const glm::dvec2 size = glm::dvec2(session.window.size()) / session.window.contentScale();
        settings.width = static_cast<int>(std::lround(size.x));
        settings.height = static_cast<int>(std::lround(size.y));
    }
    try {
        writeViewSettings(viewSettingsPath(), settings);
    } catch (const Error& error) {
        if (!session.options.quiet) printMessage("warning: cannot save the settings: {}\n", error.what());
    }
}

void takeScene(Session& session) {
    if (!takeLoadedScene(session.document, session.state)) return;
    session.still.reset();  // the running export refers to the old scene
    session.window.setTitle(session.document.frame->sceneName + " – defocus");
}

// Applies events and elapsed time to state, document and picture.
void updateFrame(Session& session, const std::vector<WindowEvent>& events, double elapsed) {
    ViewState& state = session.state;
    Document& document = session.document;
    const InputContext context = inputContext(session);
    for (const WindowEvent& event : events) session.input.handle(event, context, state, session.actions);
    layOut(session);
    if (document.frame) {
        const bool widgetHeld = ImGui::IsAnyItemActive();
        session.input.fly(context, elapsed, state);
        advance(*document.frame->scene, state, elapsed);
        if (!session.still) updateWorld(document, state, widgetHeld);
        noteEdit(document, state, widgetHeld || session.input.holds());
    }
    updatePicture(session.picture, document, state, session.window.software(), session.times.interface,
                  session.still.has_value());
    stepExport(session.still, state);
}

void drawPicture(const Session& session) {
    if (!session.picture.image) return;
    // ImGui identifies textures by pointers.
    const auto texture = static_cast<std::uintptr_t>(session.picture.image->texture().name());
    const ImVec2 end(static_cast<float>(session.state.area.size.x), static_cast<float>(session.state.area.size.y));
    // Flip the image vertically, because row 0 of the texture is the bottom row.
    ImGui::GetBackgroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(texture), {0, 0}, end, {0, 1}, {1, 0});
}

void drawInterface(Session& session) {
    const auto scale = static_cast<float>(interfaceScale(session));
    const Ui ui{session.state, session.actions, session.document,        session.picture,
                session.still, session.times,   session.window.device(), scale};
    drawPicture(session);
    drawHud(ui);
    if (session.state.panel) drawPanels(ui);
    drawExportDialog(ui);
    if (const auto chosen = drawOpenDialog(session.openDialog, session.state, scale)) session.actions.open = chosen;
}

void takeScreenshot(Session& session) {
    std::filesystem::path path;
    int number = 0;
    do path = fmt::format("defocus-view-{:03}.png", ++number);
    while (std::filesystem::exists(path));
    try {
        writeImage(path, session.window.pixels());
        say(session.state, "Written: " + path.string());
    } catch (const Error& error) {
        sayFault(session.state, error.what());
    }
}

void act(Session& session) {
    const ViewActions actions = std::exchange(session.actions, {});
    ViewState& state = session.state;
    try {
        if (actions.openDialog) openSceneDialog(session.openDialog, state);
        if (actions.toggleFullscreen) session.window.setFullscreen(!session.window.fullscreen());
        actOnDocument(session.document, state, actions, session.still.has_value());
        const auto copied = actOnExport(session.still, session.document, state, actions);
        if (copied) session.window.setClipboard(*copied);
        if (actions.quit) session.window.close();
    } catch (const Error& error) {
        sayFault(state, error.what());
    }
}

// Ends the latency measurement if the frame shows the effect of input events. Drops the measurement if the events have
// no effect.
void noteLatency(Session& session, bool pictureChanged) {
    if (pictureChanged)
        session.times.latency.shown(Clock::now());
    else if (!session.state.pull)  // keep measuring during a focus pull, whose first step shows in the next frame
        session.times.latency.forget();
}

void noteFrameTime(Session& session, Clock::time_point begin) {
    FrameTimes& times = session.times;
    times.frame = session.growthTime + millisecondsSince(begin);
    times.recent.push_back(static_cast<float>(times.frame));
    if (times.recent.size() > shownFrameTimes) times.recent.erase(times.recent.begin());
}

void drawFrame(Session& session) {
    session.places = takePlaces();
    const std::vector<WindowEvent> events = fetchEvents(session);
    const SessionOptions& options = session.options;
    if (session.window.framebufferSize().x < 1 || session.window.framebufferSize().y < 1) {  // the window is minimized
        takeScene(session);
        session.window.poll(0.05);
        return;
    }
    const Clock::time_point begin = Clock::now();
    const double elapsed = 1e-3 * millisecondsSince(session.begin) - session.state.now;
    session.state.now += elapsed;
    session.interface.beginFrame(session.state.dark, interfaceScale(session), events);
    takeScene(session);
    const auto changes = [&] { return session.picture.image ? session.picture.image->changes() : 0; };
    const std::uint64_t changesBefore = changes();
    updateFrame(session, events, elapsed);

    const Clock::time_point interfaceBegin = Clock::now();
    session.window.beginFrame(windowColor(session.state.dark));
    drawInterface(session);
    session.interface.endFrame();
    const bool sceneShown = session.picture.image && !session.document.draft;
    const bool last = sceneShown && session.framesWithScene + 1 == options.frames;
    if (last && !options.screenshot.empty()) writeImage(options.screenshot, session.window.pixels());
    if (session.actions.screenshot) takeScreenshot(session);
    session.window.endFrame();
    noteLatency(session, changes() != changesBefore);
    session.times.interface = millisecondsSince(interfaceBegin);
    act(session);
    if (sceneShown) ++session.framesWithScene;
    ++session.framesDrawn;
    noteFrameTime(session, begin);
    writeStats(session);
}

}  // namespace

Session::Session(const SessionOptions& chosen)
    : options(chosen), settings(rememberedSettings()), window(windowOptions(chosen, settings)), interface(window) {
    state.options = options.request;
    state.exposure = exposureOf(options.request).value_or(0);
    state.dark = settings.dark;
    state.panel = settings.panel;
    state.interfaceScale = settings.interfaceScale;
    state.budget = windowBudget(window.software());
    state.budget.milliseconds = settings.budgetMilliseconds.value_or(state.budget.milliseconds);
    state.printsFaults = !options.quiet && options.frames == 0;
    state.recent = readRecentFiles(recentFilesPath());
    document.shaderFolder = options.shaderFolder;
    document.remembersFiles = options.frames == 0;
    document.loader.open(options.request);
}

void runSession(const SessionOptions& options) {
    Session session(options);
    const auto done = [&] { return options.frames > 0 && session.framesWithScene >= options.frames; };
    while (!session.window.closing() && !done()) {
        drawFrame(session);
        const bool failed = !session.state.fault.empty() && !session.document.frame && !session.document.loader.busy();
        if (options.frames > 0 && failed) throw Error(session.state.fault);
    }
    writeStats(session, true);
    rememberSettings(session);
}

}  // namespace defocus::engine
