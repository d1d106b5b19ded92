#pragma once
// Runs the window of the command `defocus view`.

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
    Request request;                   // all settings; Request::size is the size of the picture
    std::filesystem::path screenshot;  // file for a screenshot of the last frame; empty: none
    int frames = 0;  // number of frames drawn with the complete scene before the window closes; 0: no limit
    std::filesystem::path shaderFolder;  // replacement shaders; empty: the embedded shaders
    bool quiet = false;                  // true: print no warnings on stderr
    std::filesystem::path stats;         // JSON file to which the window's state is written continuously; empty: none
};

// Opens a window and the scene; returns once the window is closed. Throws Error if there is no display or, with
// SessionOptions::frames, if the scene can't be opened.
void runSession(const SessionOptions& options);

// State of a running window: scene, picture, interface and input events.
struct Session {
    explicit Session(const SessionOptions& options);

    const SessionOptions& options;
    ViewSettings settings;
    Window window;
    ViewInterface interface;
    ViewInput input;
    ViewState state;
    ViewActions actions;  // actions that panels and keys requested in this frame
    Document document;
    LivePicture picture;
    std::optional<StillExport> still;
    OpenDialog openDialog;
    FrameTimes times;

    std::deque<WindowEvent> events;                // events that were fetched, but not yet handled by a frame
    Clock::time_point queuedSince = Clock::now();  // time at which the earliest of `events` arrived
    Clock::time_point fetchedAt = Clock::now();
    double growthTime = 0;  // time spent in this frame on adding samples to the image of a view at rest, ms

    const Clock::time_point begin = Clock::now();
    int framesWithScene = 0;  // frames drawn with the complete scene, not with a draft
    std::uint64_t framesDrawn = 0;
    double statsWrittenAt = -1;  // when the state was last written, in s since the window was opened; −1: never
    Places places;               // positions of the widgets in the latest frame
};

// Returns the scale of the interface: px per interface unit.
double interfaceScale(const Session& session);

[[nodiscard]] bool dialogOpen(const Session& session);
InputContext inputContext(const Session& session);

// Sets ViewState::area and pictureSize from the size of the window.
void layOut(Session& session);

// Returns the events of the next frame. First adds samples to the picture if the view is at rest, and waits if there is
// nothing else to do.
std::vector<WindowEvent> fetchEvents(Session& session);

// Writes the state to the file SessionOptions::stats, at most five times a second unless `now` is true.
void writeStats(Session& session, bool now = false);

}  // namespace defocus::engine
