#pragma once
// Draws frames of a world to the end: in one piece, in tiles if memory is short, or the sums of some lens samples. It
// is the only code that chooses how a renderer is made and fed; stills, films, the window's exports and the library use
// it.
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
    std::filesystem::path shaderFolder;  // overrides the embedded shaders; empty: none
    std::uint64_t keptPixelBytes = 0;    // bytes a pixel of the images that the caller keeps in main memory meanwhile
};

// Takes finished rows of a frame that is drawn in tiles, from the top.
using RowSink = std::function<void(const RowRange& rows, Image&& pixels)>;

// One frame, or a part of it.
struct FrameOrder {
    View view;
    RenderSettings settings;
    StopSettings stop = {};
    std::optional<SampleRange> samples = {};         // only the sums of these lens samples, for FrameDriver::sums
    std::optional<std::vector<RowRange>> rows = {};  // only these rows, in tiles; none: the whole frame
    RowSink takeRows = {};                           // empty: image() keeps the rows of tiles
    std::string whole = {};  // why the frame must be drawn in one piece; empty: tiles are allowed
};

class FrameDriver {
public:
    // `world` must outlive the driver; its pose, shutter and lights may change between frames. Methods with
    // Method::needsGl need a current GL context in all calls. Throws Error for settings that the method doesn't take.
    FrameDriver(const World& world, DriverOptions options);
    ~FrameDriver();
    FrameDriver(FrameDriver&&) noexcept;
    FrameDriver& operator=(FrameDriver&&) noexcept;

    // Begins a frame. The first frame of a size decides about tiles for all that follow. Throws Error for a frame that
    // fits into memory neither in one piece nor in tiles, and for a part that the method cannot draw by itself.
    void start(FrameOrder order);
    // Draws one wave of samples; false once the frame is done.
    bool advance();

    // Whether a frame was started; all members below need one.
    [[nodiscard]] bool started() const { return drawing_ != nullptr; }
    [[nodiscard]] std::uint32_t samples() const;      // drawn so far; of tiles the mean over all rows, rounded down
    [[nodiscard]] std::uint32_t sampleTotal() const;  // as expected for the finished frame
    [[nodiscard]] double share() const;               // 0 … 1, of the work
    [[nodiscard]] const FramePlan& plan() const;      // of the whole frame
    [[nodiscard]] RenderStats stats() const;
    [[nodiscard]] double planMilliseconds() const;
    [[nodiscard]] int tiles() const;  // drawn so far; 1: the frame is drawn in one piece
    [[nodiscard]] bool inTiles() const;
    // Linear RGBA of the samples so far; unfinished tiles are black with alpha 0. Not for frames whose rows go to a
    // sink.
    [[nodiscard]] Image image();
    // The sums of FrameOrder::samples, once the frame is done; without settings and metadata.
    [[nodiscard]] FramePart sums();
    // Whether memory is too short for DriverOptions::keptPixelBytes: images should be written before the next frame.
    [[nodiscard]] bool crowded() const { return crowded_; }
    [[nodiscard]] std::uint64_t memoryLimit() const { return limit_; }
    [[nodiscard]] const MethodUse& method() const { return options_.method; }

private:
    class Drawing;
    class Whole;
    class Tiled;
    class Summed;

    // What the choice between one piece and tiles depends on, beside the world and the options.
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
    std::uint64_t limit_ = 0;  // bytes of the process
    bool crowded_ = false;
    std::optional<Fit> fitted_;               // for which the waves and the bands were chosen
    std::optional<std::vector<Band>> bands_;  // none: frames are drawn in one piece
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<Drawing> drawing_;
};

// Returns the plan of a frame that is drawn in tiles. An automatic number of samples becomes that which the blur asks
// for: the error of an image, which may end a frame in one piece earlier, is known only once all of it is drawn.
FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings, bool automaticSamples);

}  // namespace defocus::engine
