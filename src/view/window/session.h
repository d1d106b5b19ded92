#pragma once
// Runs the window of `defocus view`.

#include <deque>

#include "core/stopwatch.h"
#include "view/document/kept_files.h"
#include "view/export/export.h"
#include "view/panels/open_dialog.h"
#include "view/widgets/ui.h"
#include "view/widgets/widgets.h"
#include "view/window/input.h"
#include "view/window/interface.h"

namespace defocus::engine {

struct SessionOptions {
    Request request;                     // request; its size is the size of the picture
    std::filesystem::path screenshot;    // file for a screenshot of the window at the end; empty: none
    int frames = 0;                      // number of frames with the scene before the window closes; 0: no limit
    std::filesystem::path shaderFolder;  // empty: the embedded shaders
    bool quiet = false;                  // no warnings on stderr
    std::filesystem::path stats;         // file for the state as JSON, updated continuously; empty: none
};

// Opens a window and the scene; returns once the window is closed. Throws Error without a display, and, with `frames`,
// for a scene that can't be opened.
void runSession(const SessionOptions& options);

// The parts of a running session.
struct Session {
    explicit Session(const SessionOptions& options);

    const SessionOptions& options;
    ViewSettings settings;
    Window window;
    ViewInterface interface;
    ViewInput input;
    ViewState state;
    ViewActions actions;  // actions of this frame
    Document document;
    LivePicture picture;
    std::optional<StillExport> still;
    OpenDialog openDialog;
    FrameTimes times;

    std::deque<WindowEvent> events;                // not yet taken by a frame
    Clock::time_point queuedSince = Clock::now();  // arrival of the earliest of `events`
    Clock::time_point fetchedAt = Clock::now();
    double growthTime = 0;  // ms that the frame spent on the still image

    const Clock::time_point begin = Clock::now();
    int framesWithScene = 0;  // frames of the complete scene, not of a draft
    std::uint64_t framesDrawn = 0;
    double statsWrittenAt = -1;  // s, as ViewState::now
    Places places;               // widget positions in the latest frame
};

// Returns the px per unit of the interface.
double interfaceScale(const Session& session);

[[nodiscard]] bool dialogOpen(const Session& session);
InputContext inputContext(const Session& session);

// Sets ViewState::area and pictureSize from the window's size.
void layOut(Session& session);

// Returns the events of the next frame. Adds samples to a still picture first; sleeps if there is nothing to do.
std::vector<WindowEvent> fetchEvents(Session& session);

// Writes the state to SessionOptions::stats, several times a second; `now`: immediately.
void writeStats(Session& session, bool now = false);

}  // namespace defocus::engine
