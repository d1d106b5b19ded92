#pragma once
// Renders requests of one scene, frame after frame: still images, frames of a shot, and exports of the window.
// Implements the public SceneRenderer (defocus/renderer.h). The scene is loaded once; its pyramids are reused between
// frames.
//
//   SceneDriver driver(nullptr, request, shaderFolder, progress);
//   driver.start(request);            // or, for a frame of a shot: driver.pose(request, moment); driver.start();
//   while (driver.advance()) {}
//   driver.write(path, driver.image());

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "defocus/renderer.h"
#include "frame/driver/frame_driver.h"
#include "frame/report/render_report.h"
#include "frame/setup/frame_moment.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "lod/pyramid/shared_pyramids.h"
#include "render/aov/aov.h"

namespace defocus::engine {

class SceneDriver {
public:
    // Loads the scene that the request names, or uses `scene` if it isn't null, and places camera, lens and lights.
    // Checks the request, scene and lens. Throws Error in the same cases as SceneRenderer.
    SceneDriver(std::shared_ptr<const Scene> scene, const Request& request, std::filesystem::path shaderFolder,
                const Progress& progress);
    // Draws moments of the scene of `frame`, which must match the request: only with pose() and start(parts), and in
    // the caller's current GL context unless openContext() is called.
    SceneDriver(PreparedFrame frame, const Request& request, std::filesystem::path shaderFolder);
    ~SceneDriver();
    SceneDriver(const SceneDriver&) = delete;
    SceneDriver& operator=(const SceneDriver&) = delete;

    // Prepares a still image before start(request), which otherwise does this itself: chooses whether to use levels of
    // detail, opens the GL context and builds the pyramids.
    void prepare(const Progress& progress);
    // Opens the GL context if the driver has none. Throws Error without a usable device.
    void openContext();
    // Builds the pyramids that the settings of frame() need, unless they are built.
    void buildPyramids(const Progress& progress);
    // Makes the driver's GL context current on this thread.
    void makeCurrent();

    // Begins a still image. If the request fails its checks, throws Error and leaves the previous frame unchanged.
    void start(const Request& request, const FrameParts& parts = {}, const Progress& progress = {});
    // Replaces pose, lights, camera, lens and settings of frame() by those of a moment of the same scene, whose
    // pyramids must be built before the next start(). The time and seed of the request are those of the moment.
    void pose(Request request, const FrameMoment& moment);
    // Begins the frame that pose() described. Throws Error in the same cases as FrameDriver::start.
    void start(const FrameParts& parts = {});
    // Draws a batch (wave) of lens samples. Returns false once the frame is complete.
    bool advance();

    [[nodiscard]] const Request& firstRequest() const { return first_; }
    [[nodiscard]] const Request& request() const { return request_; }  // request of the frame that was started last
    [[nodiscard]] const PreparedFrame& frame() const { return frame_; }
    [[nodiscard]] std::shared_ptr<const Scene> scene() const { return scene_->loaded(); }
    [[nodiscard]] const GlContext& context() const { return *context_; }

    [[nodiscard]] bool started() const { return driver_.has_value(); }
    // Returns the timings, and the sample and triangle counts, of the frame that was started last. Before the first
    // frame, returns only the loading times.
    [[nodiscard]] RenderStatistics statistics() const;

    // Returns warnings for the user: about the scene, the request and, after start(), the frame.
    [[nodiscard]] std::vector<std::string> warnings() const;

    // Returns the hash that all parts of the frame share; see frame/setup/settings_hash.h.
    [[nodiscard]] std::string settingsHash() const;

    // All functions below require a started frame.
    [[nodiscard]] FrameDriver& driver();
    [[nodiscard]] const FrameDriver& driver() const;
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] Image image();  // throws Error if no sample has been drawn
    [[nodiscard]] AovImages aovs();
    [[nodiscard]] std::optional<LayerImages> layerImages();  // nullopt without Request::layers
    [[nodiscard]] Image work();
    // Returns the settings for encoding the image as PNG and JPEG. A metered exposure is measured for the first frame
    // and then kept.
    [[nodiscard]] WriteOptions writeOptions();
    [[nodiscard]] Metadata metadata();
    // `command`: the command line in shell syntax; empty: none. `milliseconds`: time since the command began.
    [[nodiscard]] RenderReport report(std::string command = {}, double milliseconds = 0);
    // Returns the report of an image that was computed from lens images of this driver. `plan` must outlive the report.
    [[nodiscard]] RenderReport report(const FramePlan& plan, const RenderStats& stats);
    // Writes an image of the frame to a file, with the frame's metadata; EXR files also get the layers.
    void write(const std::filesystem::path& path, const ImageView& image);

private:
    // Makes the driver's GL context current during the object's lifetime, then restores the caller's context.
    struct InContext {
        explicit InContext(GlContext* context) {
            if (context != nullptr) context->makeCurrent();
        }
        CurrentContextKeeper callers;
    };
    // Number of kinds of pyramids. Kind 0 has full detail only; kind 1 + n has levels built with the LevelVertices
    // enumerator of value n.
    static constexpr std::size_t pyramidKinds = 4;
    struct Built {
        SharedPyramids pyramids;
        std::size_t loaded = 0;
        std::string cacheFailure;
    };

    [[nodiscard]] InContext inContext() const { return InContext(context_.get()); }
    void givePyramids(PreparedFrame& frame, const Progress& progress);
    void resetDriver();
    void replaceRequest(Request request);

    bool named_ = false;  // true: the request names the scene; false: the caller passed the scene
    std::filesystem::path shaderFolder_;
    Request first_, request_;
    std::optional<SharedScene> scene_;  // nullopt: the caller prepared the frame
    PreparedFrame frame_;               // frame of request_; must outlive driver_, which refers to frame_.world
    std::array<std::optional<Built>, pyramidKinds> built_;  // indexed by pyramidKind
    bool builtGround_ = false;                              // whether the pyramids in built_ include a ground
    double loadMilliseconds_ = 0;
    double pyramidMilliseconds_ = 0;
    std::optional<double> metered_;       // metered exposure, EV
    std::vector<std::string> clipped_;    // warnings about clipping in the latest written 8-bit image
    std::unique_ptr<GlContext> context_;  // null until openContext(): the caller's context is used
    std::optional<FrameDriver> driver_;
};

}  // namespace defocus::engine
