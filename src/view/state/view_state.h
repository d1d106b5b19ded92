#pragma once
// Holds, as plain data, everything that the window shows and that the user can change.

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

// Area of the window that shows the picture, from the window's top left corner. Sizes and positions are in window
// units.
struct PictureArea {
    glm::dvec2 size{1.0};
    // Maps a window position in this area to [−1, 1] in x and y, with y up.
    [[nodiscard]] glm::dvec2 normalized(const glm::dvec2& position) const;
    [[nodiscard]] bool contains(const glm::dvec2& position) const;
};

// Returns the tangents of half the horizontal and half the vertical field of view.
glm::dvec2 tanHalfFov(const Lens& lens, const PictureArea& area);

struct PickedSurface {
    int object = -1;        // index into Pose::objects
    double depth = 0;       // depth in m along the view axis
    glm::dvec3 point{0.0};  // position in world space
};

// Returns the surface under a window position; nullopt if the picture shows no surface there.
std::optional<PickedSurface> pickedSurface(const PreparedFrame& frame, const ViewCamera& camera, const Lens& lens,
                                           const PictureArea& area, const glm::dvec2& position);

enum class Navigation { orbit, fly };

// Image that is shown to the right of the divider, for comparison with the image of the current settings on the left.
enum class Comparison {
    none,
    fullDetail,  // image at full detail, with the same lens samples as the image on the left
    nearest,     // image with one level per object (LodMode::nearest)
    reference,   // image at full detail; its lens samples differ from those of the image on the left
    method,      // image drawn with the method ViewState::comparedMethod
};

struct Message {
    std::string text;
    bool fault = false;
    double until = 0;  // time at which the message disappears, in s since the window was opened
};

// Marker of the point that was last clicked to focus; it fades out.
struct FocusMarker {
    bool shown = false;
    std::uint64_t number = 0;  // number of the click, counted from 1
    glm::dvec3 point{0.0};     // position in world space
    double since = 0;          // time of the click, in s since the window was opened
    std::string name;          // name of the object; empty: no surface was hit
    double distance = 0;       // focus distance, m
};

// State of the dialog for exporting a still.
struct ExportDialog {
    bool fresh = true;           // true in the frame in which the dialog opens
    bool asksToReplace = false;  // true: the dialog asks whether to replace an existing file
};

struct SavedView {
    std::string name;
    ViewCamera camera;
    double nearPlane = 0.01;  // m
    Lens lens;                // lens; its aperture image is neither stored in the file of saved views nor restored
};

struct ShotKey {
    View view;
    double pivotDistance = 1;  // distance from the camera to its target, m
    double time = 0;           // time of the animation, s
};

// State that undo and redo restore.
struct ViewEdit {
    Request options;
    ViewCamera camera;
    Lens lens;
    double nearPlane = 0.01;     // m
    bool followsCamera = false;  // true: the view follows the file's camera, which may be animated
    double exposure = 0;         // exposure in EV; if `meters` is true, the latest metered value
    bool meters = false;         // true: the exposure is metered whenever the view comes to rest
};

// State that is reset when another scene is opened.
struct SceneState {
    int selected = -1;  // index into Pose::objects of the object last focused on; −1: none
    bool playing = false;
    std::optional<FocusPull> pull;
    FocusMarker marker;
    std::vector<glm::dvec3> focusPoints;  // points in world space; three points determine the plane of focus
    // Start of the popping test, in s since the window was opened; nullopt: not running.
    std::optional<double> poppingSince;
    std::vector<ShotKey> shotKeys;
    std::vector<SavedView> savedViews;
};

struct ViewState : ViewEdit, SceneState {
    // ---- current frame, set by the window loop
    double now = 0;             // seconds since the window was opened
    PictureArea area;           // window area that shows the picture
    glm::ivec2 pictureSize{1};  // size of the picture, px

    // ---- camera and animation
    Navigation navigation = Navigation::orbit;  // how dragging the mouse moves the camera
    double animationSpeed = 1;

    // ---- settings of the picture
    DisplaySettings display;  // exposure and tone map are ignored; ViewEdit's `exposure` and `options` replace them
    Comparison comparison = Comparison::none;
    std::string comparedMethod = "circular";
    FrameBudget budget;
    std::uint32_t maxSamples = 4096;        // max lens samples of a view at rest
    std::uint64_t imageBytes = 1ull << 30;  // max size of the kept lens images in bytes; 0: none are kept

    // ---- appearance of the window, recent files and messages
    bool panel = true;
    bool help = false;
    bool dark = true;
    double interfaceScale = 1;                  // multiplies the scale of the screen
    std::vector<std::filesystem::path> recent;  // scenes that were opened recently, latest first
    std::deque<Message> messages;
    std::string fault;          // latest error message
    bool printsFaults = false;  // true: also print error messages on stderr

    // ---- contents of text fields, and state of dialogs
    std::string openPath, viewName, environmentPath, aperturePath;
    bool environmentIsFile = false;  // true: the field for an environment file is shown
    std::string exportPath = "still.png";
    std::optional<glm::ivec2> exportSize;  // size of the exported still image, px; nullopt: pictureSize
    std::optional<ExportDialog> exportDialog;
    std::string shotPath = "shot.json";
};

// Actions that panels and keys request. They need files, the GPU or the window, so they are executed at the end of the
// frame.
struct ViewActions {
    std::optional<std::filesystem::path> open;
    std::optional<std::string> chooseCamera;  // name of the camera; "auto" frames the scene
    bool undo = false;
    bool redo = false;
    bool resetAll = false;
    std::optional<std::string> saveView;  // name of the view to save
    std::optional<std::size_t> goToView;  // index into ViewState::savedViews
    std::optional<std::size_t> deleteView;
    bool copyCommand = false;
    bool recordKey = false;
    bool saveShot = false;
    bool askExport = false;    // true: open the dialog for exporting a still
    bool exportStill = false;  // true: write the still to ViewState::exportPath, and replace an existing file
    bool cancelExport = false;
    bool openDialog = false;
    bool screenshot = false;
    bool toggleFullscreen = false;
    bool quit = false;
};

// Returns the exposure of the picture in EV: from the lens if it has an exposure time, else ViewState::exposure.
double shownExposure(const ViewState& state);

// Returns the settings with which the picture is encoded in 8 bits: exposure and tone map.
WriteOptions writeOptions(const ViewState& state);

// say() and sayFault() show a message over the picture for some seconds; sayFault() is for errors.
void say(ViewState& state, std::string text);
void sayFault(ViewState& state, std::string text);

// Chooses the image to the right of the divider. Centres the divider if it is at the picture's right edge.
void compare(ViewState& state, Comparison comparison);

// Starts a focus pull to `distance` m that takes `seconds`.
void pullFocus(ViewState& state, double distance, double seconds = FocusPull{}.duration);

// Sets the plane of focus to contain the three focus points, then clears the points.
void tiltFocus(ViewState& state);

// Each of these functions moves the camera so that the selected object, or the entire scene, fills the image. It also
// pulls the focus to the centre of that object or scene.
void frameSelection(const PreparedFrame& frame, ViewState& state);
void frameScene(const PreparedFrame& frame, ViewState& state);

inline constexpr double poppingDuration = 8;  // duration of the popping test, s
// Starts or stops the popping test, which shows visible switches between levels of detail (popping). The test is a
// focus pull from near to far and back, with fractional levels on the left side and nearest levels on the right.
void togglePoppingTest(ViewState& state);

// Advances the focus pull and the animation by `seconds`, and ends the popping test after poppingDuration.
void advance(const Scene& scene, ViewState& state, double seconds);

// Returns the --clip value of a clip of the scene: its name, or its index if the name is ambiguous.
std::string clipText(const Scene& scene, int clip);

}  // namespace defocus::engine
