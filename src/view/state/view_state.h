#pragma once
// All state that the window shows and the user can change, as plain data.

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"
#include "render/display/display_pass.h"
#include "view/state/camera_controls.h"
#include "view/state/focus_pull.h"
#include "view/state/frame_budget.h"

namespace defocus::engine {

// Area of the picture, from the window's top left corner; sizes and positions are in window units.
struct PictureArea {
    glm::dvec2 size{1.0};
    // Maps a position to [−1, 1], y up.
    [[nodiscard]] glm::dvec2 normalized(const glm::dvec2& position) const;
    [[nodiscard]] bool contains(const glm::dvec2& position) const;
};

// Returns the tangents of half the horizontal and the vertical field of view.
glm::dvec2 tanHalfFov(const Lens& lens, const PictureArea& area);

struct PickedSurface {
    int object = -1;        // index into Pose::objects
    double depth = 0;       // m along the view axis
    glm::dvec3 point{0.0};  // world space
};

// Returns the surface under a position; none where the picture shows none.
std::optional<PickedSurface> pickedSurface(const PreparedFrame& frame, const ViewCamera& camera, const Lens& lens,
                                           const PictureArea& area, const glm::dvec2& position);

enum class Navigation { orbit, fly };

// The image on the right side of the divider.
enum class Comparison {
    none,
    fullDetail,  // the same lens samples, full detail
    nearest,     // one integer level per object
    reference,   // full detail, other lens samples
    method,      // ViewState::comparedMethod
};

struct Message {
    std::string text;
    bool fault = false;
    double until = 0;  // s, as ViewState::now
};

// Mark of the latest click to focus; it fades out.
struct FocusMarker {
    bool shown = false;
    std::uint64_t number = 0;  // number of the click, from 1
    glm::dvec3 point{0.0};     // world space
    double since = 0;          // s, as ViewState::now
    std::string name;          // name of the object; empty: the click hit none
    double distance = 0;       // m, focus distance
};

// Dialog for the file of a still.
struct ExportDialog {
    bool fresh = true;           // opened in this frame
    bool asksToReplace = false;  // the file exists
};

struct SavedView {
    std::string name;
    ViewCamera camera;
    double nearPlane = 0.01;  // m
    Lens lens;                // without the aperture image, which a view doesn't store
};

struct ShotKey {
    View view;
    double pivotDistance = 1;  // m ahead of the camera: its target
    double time = 0;           // s into the animation
};

// State that undo and redo cover.
struct ViewEdit {
    Request options;
    ViewCamera camera;
    Lens lens;
    double nearPlane = 0.01;     // m
    bool followsCamera = false;  // the camera is the file's, as its animation moves it
    double exposure = 0;         // EV; the meter's latest reading where `meters` is set
    bool meters = false;         // the exposure is metered whenever the view comes to rest
};

// State that is reset with each scene.
struct SceneState {
    int selected = -1;  // index into Pose::objects of the object last focused on
    bool playing = false;
    std::optional<FocusPull> pull;
    FocusMarker marker;
    std::vector<glm::dvec3> focusPoints;  // world space; the focus plane goes through them once there are three
    std::optional<double> poppingSince;   // s; start of the popping test, none while it does not run
    std::vector<ShotKey> shotKeys;
    std::vector<SavedView> savedViews;
};

struct ViewState : ViewEdit, SceneState {
    // The current frame, set by the window loop.
    double now = 0;             // s since the window opened
    PictureArea area;           // window units
    glm::ivec2 pictureSize{1};  // px

    // Camera and scene.
    Navigation navigation = Navigation::orbit;
    double animationSpeed = 1;

    // Picture.
    DisplaySettings display;  // exposure and tone map are set from `exposure` and `options`
    Comparison comparison = Comparison::none;
    std::string comparedMethod = "circular";
    FrameBudget budget;
    std::uint32_t maxSamples = 4096;  // max samples of a still view

    // Window.
    bool panel = true;
    bool help = false;
    bool dark = true;
    double interfaceScale = 1;                  // multiplies the screen's own scale
    std::vector<std::filesystem::path> recent;  // recent scenes, latest first
    std::deque<Message> messages;
    std::string fault;          // text of the latest failure
    bool printsFaults = false;  // also prints faults on stderr

    // Text fields.
    std::string openPath, viewName, environmentPath, aperturePath;
    bool environmentIsFile = false;  // the field for the environment's file is shown
    std::string exportPath = "still.png";
    std::optional<glm::ivec2> exportSize;  // px; none: pictureSize
    std::optional<ExportDialog> exportDialog;
    std::string shotPath = "shot.json";
};

// Requests from panels and keys that need files, the GPU or the window. They are executed at the end of the frame.
struct ViewActions {
    std::optional<std::filesystem::path> open;
    std::optional<std::string> chooseCamera;  // by name; "auto" frames the scene
    bool undo = false;
    bool redo = false;
    bool resetAll = false;
    std::optional<std::string> saveView;  // name of the view to save
    std::optional<std::size_t> goToView;  // index into ViewState::savedViews
    std::optional<std::size_t> deleteView;
    bool copyCommand = false;
    bool recordKey = false;
    bool saveShot = false;
    bool askExport = false;    // opens the export dialog
    bool exportStill = false;  // to ViewState::exportPath, replacing the file
    bool cancelExport = false;
    bool openDialog = false;
    bool screenshot = false;
    bool toggleFullscreen = false;
    bool quit = false;
};

// Returns the exposure of the picture in EV: the lens's if it has an exposure time, else ViewState::exposure.
double shownExposure(const ViewState& state);

// Returns exposure and tone map of 8-bit images.
WriteOptions writeOptions(const ViewState& state);

// Shows a message over the picture for some seconds.
void say(ViewState& state, std::string text);
void sayFault(ViewState& state, std::string text);

// Sets the image on the right side of the divider, and moves the divider into view.
void compare(ViewState& state, Comparison comparison);

// Starts to pull the focus to `distance` m.
void pullFocus(ViewState& state, double distance, double seconds = FocusPull{}.duration);

// Tilts the focus plane through the three focus points and clears them.
void tiltFocus(ViewState& state);

// Frames the selected object, or the scene, and pulls the focus to its centre.
void frameSelection(const PreparedFrame& frame, ViewState& state);
void frameScene(const PreparedFrame& frame, ViewState& state);

// Starts or stops the popping test: a focus pull from near to far and back, with fractional levels on the left and
// nearest levels on the right.
inline constexpr double poppingDuration = 8;  // s
void togglePoppingTest(ViewState& state);

// Advances the focus pull and the animation by `seconds`; ends a finished popping test.
void advance(const Scene& scene, ViewState& state, double seconds);

// Returns the value of --clip for a clip of the scene: its name, or its number if the name is ambiguous.
std::string clipText(const Scene& scene, int clip);

}  // namespace defocus::engine
