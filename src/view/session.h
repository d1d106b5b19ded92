#pragma once
// A window on a scene, from its first frame to its last: events change the state, the state makes a picture, the
// interface shows both.

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "core/stopwatch.h"
#include "view/edit_history.h"
#include "view/event_pacing.h"
#include "view/file_chooser.h"
#include "view/hud.h"
#include "view/input_latency.h"
#include "view/interface.h"
#include "view/panel.h"
#include "view/scene_loader.h"
#include "view/settings.h"
#include "view/still_export.h"

namespace defocus {

struct SessionOptions {
    Request request;                     // its size is that of the picture
    std::filesystem::path screenshot;    // of the window at the end; empty: none
    int frames = 0;                      // ends after as many frames with the scene; 0: when it is closed
    std::filesystem::path shaderFolder;  // instead of the embedded shaders; empty: those
    bool quiet = false;                  // no warnings on stderr
    std::filesystem::path stats;         // the state as JSON, kept up to date; empty: none
};

class ViewSession {
public:
    // Opens the window and begins to open the scene. Throws Error where there is no display.
    explicit ViewSession(const SessionOptions& options);
    ~ViewSession();
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    // Until the window is closed. Throws Error for a scene that can't be opened where `frames` were asked for.
    void run();

private:
    void frame();
    void takeScene();
    void adoptScene(LoadedScene scene);
    void keepMemory();
    void refineScene(PreparedFrame& frame);
    std::vector<WindowEvent> fetchEvents();
    void noteLatency(std::uint64_t changesBefore);
    void handleEvents(const std::vector<WindowEvent>& events);
    void moveThings(double seconds);
    void noteEdits();
    void restore(const std::optional<ViewEdit>& edit, const char* otherwise);
    void stepInHistory(const ViewActions& actions);
    void meter();
    void openDialog();
    void finishDialogs(const std::optional<std::filesystem::path>& browsed);
    void open(const std::filesystem::path& scene);
    void keepViews(const ViewActions& actions);
    void hide(const Request& options);
    void poseScene();
    void lightTheScene();
    void makePicture();
    void updatePicture();
    void updateWarnings();
    void drawInterface();
    void act();
    void tiltFocus();
    void share(const ViewActions& actions);
    void exportStep();
    void chooseCamera(const std::string& name);
    void change(const Request& options);
    void changeGround(const Request& options);
    void beginExport();
    void frameBounds(bool selection);
    void takeScreenshot(const std::filesystem::path& path);
    void writeStats();
    void say(std::string text, bool fault = false);

    [[nodiscard]] double now() const;
    [[nodiscard]] ViewEdit currentEdit() const;
    [[nodiscard]] bool dialogOpen() const;
    [[nodiscard]] std::filesystem::path openFolder() const;
    [[nodiscard]] double scale() const;
    [[nodiscard]] PictureArea area() const;
    [[nodiscard]] glm::ivec2 pictureSize() const;
    [[nodiscard]] View currentView() const;
    [[nodiscard]] std::string command() const;
    [[nodiscard]] View exportView() const;  // of the size that was asked for
    [[nodiscard]] WriteOptions writeOptions() const;
    [[nodiscard]] InputContext inputContext() const;
    [[nodiscard]] PictureRequest request() const;
    [[nodiscard]] std::optional<PlacedCamera> followedCamera() const;
    [[nodiscard]] std::string sideLabel(const PictureSide& side) const;
    [[nodiscard]] double waitingTime() const;

    SessionOptions options_;
    std::filesystem::path shaderFolder_;
    bool quiet_ = false;
    ViewSettings settings_;
    Window window_;
    ViewInterface interface_;
    ViewInput input_;
    std::deque<WindowEvent> events_;  // that wait for a frame
    EditHistory history_;
    DesktopDialog desktopDialog_;
    FileBrowser browser_;
    ViewState state_;
    ViewActions actions_;
    SceneLoader loader_;
    std::unique_ptr<PreparedFrame> frame_;
    bool draft_ = false;  // its pyramids are yet to come
    std::optional<ViewPicture> picture_;
    std::optional<StillExport> export_;
    std::vector<std::string> warnings_;  // of the picture that rests
    std::vector<std::string> clipping_;  // of these
    std::optional<std::pair<double, ToneMap>> clippingKnownAt_;
    std::uint64_t poseVersion_ = 0;
    double posedTime_ = 0;
    int posedClip_ = 0;
    ShutterSettings posedShutter_;
    std::optional<double> lightAngle_, lightRadius_;  // of the lights as they are
    std::vector<glm::dmat4> shutterCameras_;          // of a camera of the file that moves while the shutter is open
    Clock::time_point begin_ = Clock::now();
    double lastFrame_ = 0;
    double statsWrittenAt_ = -1;
    std::string statsWritten_;
    Clock::time_point fetchedAt_ = Clock::now();
    Clock::time_point queuedSince_ = Clock::now();  // of the events that wait
    InputLatency latency_;
    double interfaceMilliseconds_ = 0;
    double growthMilliseconds_ = 0;  // of the frame, spent on the still image
    double frameMilliseconds_ = 0;
    std::vector<float> frameTimes_;
    int framesWithScene_ = 0;
    std::uint64_t framesDrawn_ = 0;
    std::string fault_;                     // the latest
    std::map<std::string, ImVec2> places_;  // of widgets, in the latest frame
    std::vector<double> nodeBlurs_;         // of the scene's nodes as it was opened
    bool meterDue_ = false;
};

}  // namespace defocus
