// Lays out the window, and fetches the input events of each frame.

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/panels/panels.h"
#include "view/window/event_pacing.h"
#include "view/window/session.h"

namespace defocus::engine {

namespace {

void poll(Session& session, double seconds) {
    for (WindowEvent& event : session.window.poll(seconds)) session.events.push_back(std::move(event));
}

// Returns the max time (s) to wait for an event; 0 while the view changes or the picture accumulates samples.
double idleTime(const Session& session) {
    const ViewState& state = session.state;
    const bool loading = session.document.loader.busy();
    if (!session.picture.image) return loading ? 0.03 : 0.1;
    const bool moves = state.playing || state.pull || state.poppingSince || !session.picture.image->idle();
    if (moves || session.still || session.options.frames > 0) return 0;
    if (loading || state.marker.shown) return 0.03;
    if (!session.options.stats.empty()) return 0.05;  // keeps the state file up to date
    return state.messages.empty() && !session.openDialog.desktop.running() ? 0.25 : 0.1;
}

}  // namespace

double interfaceScale(const Session& session) {
    // Round to steps of 1/8, because each scale needs a font texture of its own.
    return std::clamp(std::round(session.window.contentScale() * session.state.interfaceScale * 8) / 8, 0.5, 4.0);
}

bool dialogOpen(const Session& session) {
    return session.openDialog.browser.opened() || session.state.exportDialog.has_value();
}

InputContext inputContext(const Session& session) {
    const ImGuiIO& io = ImGui::GetIO();
    return {session.document.frame.get(), io.WantCaptureMouse, io.WantTextInput || dialogOpen(session),
            io.NavVisible && io.NavActive};
}

void layOut(Session& session) {
    ViewState& state = session.state;
    const glm::dvec2 window = glm::max(glm::dvec2(session.window.size()), glm::dvec2(1));
    const double panel = state.panel ? std::min(panelWidth * interfaceScale(session), 0.6 * window.x) : 0;
    state.area.size = glm::max(glm::dvec2(window.x - panel, window.y), glm::dvec2(1));
    const glm::dvec2 pixelsPerUnit = glm::dvec2(session.window.framebufferSize()) / window;
    const glm::ivec2 pixels(glm::round(state.area.size * pixelsPerUnit));
    state.pictureSize = glm::clamp(pixels, glm::ivec2(1), glm::ivec2(16384));
}

std::vector<WindowEvent> fetchEvents(Session& session) {
    // Events fetched now may have arrived right after the previous fetch.
    Clock::time_point earliest = session.events.empty() ? session.fetchedAt : session.queuedSince;
    poll(session, 0);
    session.growthTime = 0;
    if (session.events.empty() && session.window.framebufferSize().x > 0) {
        const Clock::time_point before = Clock::now();
        growPicture(session.picture, session.document, session.state);
        session.growthTime = millisecondsSince(before);
        poll(session, 0);
        if (!session.events.empty()) earliest = before;
    }
    if (const double seconds = idleTime(session); session.events.empty() && seconds > 0) {
        poll(session, seconds);
        earliest = Clock::now();
    }
    session.fetchedAt = Clock::now();
    layOut(session);
    if (session.events.empty()) return {};
    session.queuedSince = earliest;
    session.times.latency.arrived(earliest);
    const ImGuiIO& io = ImGui::GetIO();
    const bool interfaceHasHand =
        session.framesDrawn > 0 && (io.WantCaptureMouse || io.WantTextInput || dialogOpen(session));
    return takeEvents(session.events, {interfaceHasHand, session.state.area.size});
}

}  // namespace defocus::engine
