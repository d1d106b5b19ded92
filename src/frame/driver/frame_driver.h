#pragma once
// Draws frames of a world to the end: in one piece, in tiles if memory is short, or as sums of some lens samples.
// Stills, films, exports from the window and the library all draw their frames with it.
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

#include "render/methods.h"
#include "render/sampling/stop_settings.h"
#include "render/tiles/memory_needs.h"
#include "render/tiles/sum_file.h"

namespace defocus::engine {

struct DriverOptions {
    MethodUse method;
    DrawLimits limits;
    std::filesystem::path shaderFolder;  // replaces the embedded shaders; empty: no replacement
    std::uint64_t keptPixelBytes = 0;    // bytes per pixel of images that the caller keeps in main memory
};

// Receives the finished rows of a frame that is drawn in tiles, from top to bottom.
using RowSink = std::function<void(const RowRange& rows, Image&& pixels)>;

// A frame, or part of a frame, to draw.
struct FrameOrder {
    View view;
    RenderSettings settings;
    StopSettings stop = {};
    std::optional<SampleRange> samples = {};         // draw only these lens samples, for FrameDriver::sums; none: all
    std::optional<std::vector<RowRange>> rows = {};  // draw only these rows, in tiles; none: the whole frame
    RowSink takeRows = {};                           // receives the rows of tiles; empty: image() keeps them
    std::string whole = {};                          // why tiles are not allowed; empty: they are allowed
};

class FrameDriver {
public:
    // `world` must outlive the driver; its pose, shutter and lights may change between frames. Methods with
    // Method::needsGl need a current GL context in all calls.
    FrameDriver(const World& world, DriverOptions options);
    ~FrameDriver();
    FrameDriver(FrameDriver&&) noexcept;
    FrameDriver& operator=(FrameDriver&&) noexcept;

    // Begins a frame. Following frames of the same size and options keep the first one's choice between one piece and
    // tiles. Throws Error for a frame that fits into memory neither in one piece nor in tiles. Also throws for a part
    // that the method cannot draw by itself, and for settings that the method doesn't take.
    void start(FrameOrder order);
    // Draws one wave of samples. Returns false once the frame is done.
    bool advance();

    // Returns whether a frame was started. All members below need a started frame.
    [[nodiscard]] bool started() const { return drawing_ != nullptr; }
    [[nodiscard]] std::uint32_t samples() const;      // drawn so far; in tiles the mean over all rows, rounded down
    [[nodiscard]] std::uint32_t sampleTotal() const;  // expected for the finished frame
    [[nodiscard]] double share() const;               // finished fraction of the work, 0 … 1
    [[nodiscard]] const FramePlan& plan() const;      // plan of the whole frame
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] double planMilliseconds() const;
    [[nodiscard]] int tiles() const;  // drawn so far; 1: the frame is drawn in one piece
    [[nodiscard]] bool inTiles() const;
    // Returns linear RGBA of the samples so far; unfinished tiles are black with alpha 0. Not for frames with
    // FrameOrder::takeRows.
    [[nodiscard]] Image image();
    // Returns the sums of FrameOrder::samples once the frame is done, without settings and metadata.
    [[nodiscard]] FramePart sums();
    // Returns whether memory is too short for DriverOptions::keptPixelBytes. The caller should then write each image
    // before it starts the next frame.
    [[nodiscard]] bool crowded() const { return crowded_; }
    [[nodiscard]] std::uint64_t memoryLimit() const { return limit_; }
    [[nodiscard]] const MethodUse& method() const { return options_.method; }

private:
    class Drawing;
    class Whole;
    class Tiled;
    class Summed;

    // Inputs of the choice between one piece and tiles that may change from frame to frame.
    struct Fit {
        int width = 0;
        int height = 0;
        Shadows shadows = Shadows::automatic;
        bool stops = false;
        bool sums = false;
        bool hasSink = false;
        std::string whole;
        std::optional<std::vector<RowRange>> rows;
        bool operator==(const Fit&) const = default;
    };

    static Fit fitOf(const FrameOrder& order);
    void makeRenderer();
    void fit(const FrameOrder& order);
    void fitTiles(const FrameOrder& order, const FramePlan& plan, const std::vector<RowRange>& rows);

    const World* world_;
    DriverOptions options_;
    std::uint64_t limit_ = 0;  // maximum memory of the process, bytes
    bool crowded_ = false;
    std::optional<Fit> fitted_;               // inputs for which wave and bands were chosen
    std::optional<std::vector<Band>> bands_;  // none: frames are drawn in one piece
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<Drawing> drawing_;
};

// Returns the plan of a frame that is drawn in tiles. An automatic number of samples is derived from the blur alone. A
// frame in one piece may stop earlier, at a small estimated error; tiles know that error only when all are drawn.
FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings, bool automaticSamples);

}  // namespace defocus::engine
