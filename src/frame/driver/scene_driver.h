#pragma once
// Turns requests of one scene into pixels, frame after frame: the implementation of the public SceneRenderer
// (defocus/renderer.h), and what the program's commands use. Scene and pyramids are loaded once.

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
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "render/aov/aov.h"

namespace defocus::engine {

// Which part of a frame is drawn; see FrameOrder.
struct FrameParts {
    std::optional<SampleRange> samples = {};
    std::optional<std::vector<RowRange>> rows = {};
    RowSink takeRows = {};
    std::string whole = {};
};

class SceneDriver {
public:
    // Opens the scene that the request names, or takes `scene` if it isn't null. Checks values, scene, lens and device
    // before it builds pyramids. Throws Error as SceneRenderer does.
    SceneDriver(std::shared_ptr<const Scene> scene, const Request& request, std::filesystem::path shaderFolder,
                const Progress& progress);
    ~SceneDriver();
    SceneDriver(const SceneDriver&) = delete;
    SceneDriver& operator=(const SceneDriver&) = delete;

    // Begins a frame. A request that fails leaves the frame before as it is.
    void start(const Request& request, const FrameParts& parts = {}, const Progress& progress = {});
    // Draws one wave of samples; false once the frame is done.
    bool advance();

    [[nodiscard]] const Request& firstRequest() const { return first_; }
    [[nodiscard]] const Request& request() const { return request_; }  // of the frame that was started last
    [[nodiscard]] const PreparedFrame& frame() const { return frame_; }
    [[nodiscard]] std::shared_ptr<const Scene> scene() const { return scene_; }
    [[nodiscard]] const GlContext& context() const { return *context_; }

    [[nodiscard]] bool started() const { return driver_.has_value(); }
    // Times and figures of the frame that was started last; without one, those of loading.
    [[nodiscard]] RenderStatistics statistics() const;

    // Lines that a person should know: of the scene, of the request, and of the frame once it is started.
    [[nodiscard]] std::vector<std::string> warnings() const;

    // What the frame's parts have in common, see settingsHash.
    [[nodiscard]] std::string settingsHash() const;

    // All below need a frame that was started.
    [[nodiscard]] FrameDriver& driver();
    [[nodiscard]] const FrameDriver& driver() const;
    [[nodiscard]] Image image();  // throws Error before the first sample
    [[nodiscard]] AovImages aovs();
    [[nodiscard]] Image work();
    [[nodiscard]] Image sweptWork() const;
    // How PNG and JPEG files are made of the image. Where the exposure is metered, the first frame decides it.
    [[nodiscard]] WriteOptions writeOptions();
    [[nodiscard]] Metadata metadata();
    // `command`: the command line as a shell would take it; empty: none. `milliseconds`: of the whole command so far.
    [[nodiscard]] RenderReport report(std::string command = {}, double milliseconds = 0);
    // Writes an image of the frame with its metadata.
    void write(const std::filesystem::path& path, const ImageView& image);

private:
    // The driver's context is current as long as this lives, then the caller's again.
    struct InContext {
        explicit InContext(GlContext& context) { context.makeCurrent(); }
        CurrentContextKeeper callers;
    };
    static constexpr std::size_t pyramidKinds = 4;  // full detail alone, or levels of each LevelVertices

    [[nodiscard]] std::shared_ptr<Scene> scaledScene(const Request& request) const;
    void handOnPyramids(PreparedFrame& next, std::size_t kind);

    bool named_;  // the request names the scene
    std::filesystem::path shaderFolder_;
    Request first_, request_;
    std::shared_ptr<Scene> scene_;                                  // shared with others and never written to
    PreparedFrame frame_;                                           // of request_; the driver refers to its world
    std::array<std::vector<Pyramid>, pyramidKinds> otherPyramids_;  // of earlier frames; the present frame's are empty
    double loadMilliseconds_ = 0;
    double pyramidMilliseconds_ = 0;
    std::optional<double> metered_;     // EV
    std::vector<std::string> clipped_;  // warnings of the 8-bit image that was written last
    std::unique_ptr<GlContext> context_;
    std::optional<FrameDriver> driver_;
};

}  // namespace defocus::engine
