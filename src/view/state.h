#pragma once
// Everything that a window shows and that people can change, as plain data.

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frame/request.h"
#include "lens/photographic_exposure.h"
#include "render/display/display_pass.h"
#include "view/camera_controls.h"
#include "view/focus_pull.h"
#include "view/frame_budget.h"
#include "view/saved_views.h"
#include "view/shot.h"

namespace defocus {

enum class Navigation { orbit, fly };

// What the right side of the divider shows.
enum class Comparison {
    none,
    fullDetail,  // the same lens samples, full detail
    nearest,     // one whole level an object
    reference,   // full detail, lens samples of its own
    method,      // ViewState::comparedMethod
};

struct Message {
    std::string text;
    bool fault = false;
    double until = 0;  // s, of the window's clock
};

// Where somebody clicked to focus last; fades away.
struct FocusMarker {
    bool shown = false;
    std::uint64_t number = 0;  // of the click, from 1
    glm::dvec3 point{0.0};     // in the world
    double since = 0;          // s, of the window's clock
    std::string name;          // of what is there; empty: nothing is
    double distance = 0;       // m, of the focus
};
inline constexpr double markerDuration = 2.2;  // s

// Where a still shall go, before it is rendered.
struct ExportDialog {
    bool fresh = true;           // it has just been opened
    bool asksToReplace = false;  // the file is there already
};

struct AnimationState {
    int clip = 0;
    double time = 0;  // s
    double speed = 1;
    bool playing = false;
};

struct ViewState {
    // What is looked at, and through what.
    Request options;  // of the scene that is shown
    ViewCamera camera;
    Lens lens;
    double nearPlane = 0.01;     // m
    bool followsCamera = false;  // the file's camera, as its animation moves it
    Navigation navigation = Navigation::orbit;
    int selected = -1;  // object; the one that was focused on last
    AnimationState animation;
    std::optional<FocusPull> pull;
    FocusMarker marker;
    std::vector<glm::dvec3> focusPoints;  // in the world; fewer than three: the focus plane waits for the rest

    // How it is shown.
    DisplaySettings display;
    bool meters = false;  // the exposure is metered anew whenever the view comes to rest
    Comparison comparison = Comparison::none;
    std::string comparedMethod = "circular";
    FrameBudget budget;
    std::uint32_t mostSamples = 4096;    // of a still view
    std::optional<double> poppingSince;  // s; a focus pull with fractional and nearest level side by side runs

    // The window.
    bool panel = true;
    bool help = false;
    bool dark = true;
    double interfaceScale = 1;                  // on top of the screen's own
    std::string openPath;                       // as typed
    std::vector<std::filesystem::path> recent;  // scenes, the latest first
    std::vector<SavedView> savedViews;          // of this scene
    std::string viewName;                       // as typed, for the next
    std::string environmentPath;
    bool environmentOfFile = false;  // one is being chosen
    std::string aperturePath;
    std::string exportPath = "still.png";
    std::optional<glm::ivec2> exportSize;  // px; none: as the view is
    std::optional<ExportDialog> exportDialog;
    std::string shotPath = "shot.json";
    std::vector<ShotKey> shotKeys;
    std::deque<Message> messages;
};

inline constexpr double poppingDuration = 8;  // s, from near to far and back

// EV: of the lens where it has an exposure time, else the slider's.
inline double shownExposure(const ViewState& state) {
    return state.lens.exposureTime > 0 ? photographicExposure(state.lens) : state.display.exposure;
}

// What the panel asks for, done once it is drawn.
struct ViewActions {
    std::optional<std::filesystem::path> open;
    std::optional<std::string> chooseCamera;  // its name; "auto" frames the scene
    std::optional<Request> changed;  // ViewState::options with other surroundings, aperture image, nodeBlur or hidden
    bool copyCommand = false;
    bool openDialog = false;
    bool askExport = false;    // opens the dialog
    bool exportStill = false;  // renders it to ViewState::exportPath, whatever is there
    bool cancelExport = false;
    bool undo = false;
    bool redo = false;
    bool resetAll = false;
    bool toggleFullscreen = false;
    std::optional<std::string> saveView;  // under this name
    std::optional<std::size_t> goToView;  // into ViewState::savedViews
    std::optional<std::size_t> forgetView;
    bool screenshot = false;
    bool recordKey = false;
    bool saveShot = false;
    bool frameSelection = false;
    bool frameAll = false;
    bool togglePopping = false;
    bool focusThroughPoints = false;  // of ViewState, which are three
    bool quit = false;
};

}  // namespace defocus
