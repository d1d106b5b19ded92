#pragma once
// Draws complete frames of a world: untiled, in tiles if memory is short, or as partial sums over some of the lens
// samples. Still images, videos, exports from the window and the library all use this class.
//
//   FrameDriver driver(world, options);
//   driver.start({.view = view, .settings = settings});
//   while (driver.advance()) {}
//   Image image = driver.image();

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/request.h"
#include "render/methods.h"
#include "render/sampling/stop_settings.h"
#include "render/tiles/memory_needs.h"
#include "render/tiles/sum_file.h"

namespace defocus::engine {

struct DriverOptions {
    MethodUse method;
    DrawLimits limits;
    std::filesystem::path shaderFolder;  // shaders in this folder replace the embedded ones; empty: none
    std::uint64_t keptPixelBytes = 0;    // bytes per pixel of the images that the caller holds in main memory
};

// Returns the options of a request: its method, memory limit, number of threads, number of lens samples that are drawn
// together (in a wave) and layer format. Throws Error for an unknown method.
DriverOptions driverOptions(const Request& request, std::filesystem::path shaderFolder,
                            std::uint64_t keptPixelBytes = 0);

// Receives the finished rows of a frame that is drawn in tiles, from the top of the image to the bottom.
using RowSink = std::function<void(const RowRange& rows, Image&& pixels)>;

// Receives the image of each lens sample, in order: linear, premultiplied RGBA, and the depth in m (one channel, +∞
// where no surface writes depth).
using SampleSink = std::function<void(std::uint32_t sample, Image&& colour, Image&& depth)>;

// Selects the part of a frame to draw, and who receives the pixels.
struct FrameParts {
    std::optional<SampleRange> samples = {};         // draw only the partial sum of these samples; nullopt: all samples
    std::optional<std::vector<RowRange>> rows = {};  // draw only these rows, in tiles; nullopt: all rows
    RowSink takeRows = {};                           // receives the rows of finished tiles; empty: image() returns them
    SampleSink takeSample = {};                      // receives each lens sample's image; if set, no mean is computed
    std::string untiledReason = {};                  // reason why tiles are forbidden; empty: tiles are allowed
    bool shortDraws = false;  // true: advance() draws few samples per call; implied by a time limit
};

// Describes the frame, or the part of a frame, that is to be drawn.
struct FrameOrder {
    View view;
    RenderSettings settings;
    StopSettings stop = {};
    FrameParts parts = {};
};

class FrameDriver {
public:
    // `world` must outlive the driver; its pose, shutter and lights may change between frames. If Method::needsGl is
    // set, every call needs a current GL context.
    FrameDriver(const World& world, DriverOptions options);
    ~FrameDriver();
    FrameDriver(FrameDriver&&) noexcept;
    FrameDriver& operator=(FrameDriver&&) noexcept;

    // Begins a frame. The choice between untiled and tiled drawing is reused for later frames of the same size and
    // options. Throws Error if the frame fits into memory neither untiled nor in tiles, if the method cannot draw the
    // requested part alone, and for settings that the method doesn't support.
    void start(FrameOrder order);
    // Draws a batch (wave) of lens samples. Returns false once the frame is complete.
    bool advance();

    // Returns whether a frame was started. All functions below require a started frame.
    [[nodiscard]] bool started() const { return drawing_ != nullptr; }
    // Number of samples drawn so far; for a frame in tiles, the mean over all rows, rounded down.
    [[nodiscard]] std::uint32_t samples() const;
    [[nodiscard]] std::uint32_t sampleTotal() const;  // expected number of samples of the complete frame
    [[nodiscard]] double share() const;               // finished fraction of the work, 0 … 1; never decreases
    [[nodiscard]] const FramePlan& plan() const;      // plan of the complete frame
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] double planMilliseconds() const;
    [[nodiscard]] int tiles() const;  // number of tiles drawn so far; 1 for an untiled frame
    [[nodiscard]] bool inTiles() const;
    // Returns the linear RGBA mean of the samples so far; unfinished tiles are black with alpha 0. Not available if
    // FrameParts::takeRows is set, because finished rows are then not kept.
    [[nodiscard]] Image image();
    // Returns the images of the layers in RenderSettings::layers; nullopt if there are none.
    [[nodiscard]] std::optional<LayerImages> layerImages();
    // Returns the partial sums over FrameParts::samples; FramePart::settings and ::metadata stay empty. All these
    // samples must have been drawn.
    [[nodiscard]] FramePart sums();
    // Returns whether there is too little memory for the images counted in DriverOptions::keptPixelBytes. If so, the
    // caller should write each image before it starts the next frame.
    [[nodiscard]] bool crowded() const { return crowded_; }
    [[nodiscard]] std::uint64_t memoryLimit() const { return limit_; }
    // Returns the method that draws the frame. For method "auto", returns the method that it chose.
    [[nodiscard]] MethodUse method() const;

private:
    class Drawing;
    class Untiled;
    class Planned;
    class Tiled;
    class Summed;
    class Separate;

    // Inputs that decide whether a frame is drawn in tiles, and that may change from frame to frame.
    struct Fit {
        int width = 0;
        int height = 0;
        Shadows shadows = Shadows::automatic;
        std::uint32_t positions = 1;
        std::vector<Layer> layers;
        bool choosesPositions = false;
        bool stops = false;
        bool sums = false;
        bool hasSink = false;
        bool shortDraws = false;
        std::string untiledReason;
        std::optional<std::vector<RowRange>> rows;
        bool operator==(const Fit&) const = default;
    };

    static Fit fitOf(const FrameOrder& order);
    void makeRenderer();
    [[nodiscard]] static std::uint32_t shortWave(const FrameOrder& order);
    void fit(const FrameOrder& order);
    void fitTiles(const FrameOrder& order, const FramePlan& plan, const std::vector<RowRange>& rows);

    const World* world_;
    DriverOptions options_;
    std::uint64_t limit_ = 0;  // maximum memory of the process, bytes
    bool crowded_ = false;
    std::optional<Fit> fitted_;               // inputs from which bands_ and the samples per batch were chosen
    std::optional<std::vector<Band>> bands_;  // each band is a row of tiles; nullopt: frames are drawn untiled
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<Drawing> drawing_;
    mutable double share_ = 0;  // largest result of share() so far, so that progress never goes back
};

// Returns the plan of a frame that is drawn in tiles. An automatic number of samples is derived from the size of the
// blur alone, because the error of the image is unknown until all tiles are drawn.
FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings, std::optional<Quality> automatic);

}  // namespace defocus::engine
