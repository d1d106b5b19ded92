#pragma once
// Common interface of the renderers of all methods.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/thread_times.h"
#include "image/image.h"
#include "plan/frame_plan.h"
#include "render/layer_images.h"

namespace defocus::engine {

class GlTexture;

struct PassTime {
    std::string name;
    double milliseconds = 0;  // GPU time, summed over the frame
};

// Statistic that is specific to a method.
struct MethodFigure {
    std::string name;
    double value = 0;
};

struct RenderStats {
    std::uint32_t samples = 0;
    double setupMilliseconds = 0;       // time for uploads and for compiling shaders
    double renderMilliseconds = 0;      // time from the end of the setup until the image is complete
    CpuTime cpuTime;                    // CPU time in the interval that renderMilliseconds measures
    double gpuMilliseconds = 0;         // from timer queries, which miss vertex work on software drivers
    std::uint64_t trianglesDrawn = 0;   // triangles in the plan, summed over all samples
    std::uint64_t trianglesHidden = 0;  // triangles of the plan that were skipped because they are hidden
    std::uint64_t peakBytes = 0;        // peak size of the renderer's GPU resources
    std::uint32_t wave = 0;             // number of lens samples drawn together
    std::uint32_t threads = 1;          // number of threads that draw, each with an OpenGL context of its own
    std::string layerFormat;            // format of the layers, e.g. "rgba16f"
    std::string device;
    std::string driver;
    StopReason stopped = StopReason::sampleCount;  // why the frame ended
    std::optional<double> estimatedError;          // RMSE (see StopSettings); nullopt: not estimated
    std::vector<MethodFigure> figures;             // statistics that are specific to the method
    std::vector<PassTime> passes;                  // passes in order of execution; empty if not measured
};

// Compensated sum of the samples of one block, RGBA; the result is `sum` + `compensation`. A block has 64 samples; the
// frame's last block may have fewer. Used to render a frame on several machines.
struct BlockSum {
    std::uint32_t samples = 0;
    Image sum;
    Image compensation;
};

// Limits on the samples that are drawn together.
struct WaveLimit {
    std::uint32_t samples = 0;  // max samples whose layers are in memory at once; 0: RendererOptions::wave
    std::uint32_t perWave = 0;  // max samples drawn together, so that one advance() takes little time; 0: no limit
    std::uint32_t threads = 0;  // max threads that draw; 0: RendererOptions::threads
    // Returns the max number of samples drawn together, for methods that draw one batch (wave) of samples at a time.
    // `otherwise`: the max if `samples` is 0.
    [[nodiscard]] std::uint32_t withDefault(std::uint32_t otherwise) const {
        const std::uint32_t max = samples > 0 ? samples : otherwise;
        return perWave > 0 && (max == 0 || max > perWave) ? perWave : max;
    }
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // Starts a frame. `plan` is copied; it must have been made for this renderer's World.
    virtual void start(const FramePlan& plan) = 0;
    // Draws one batch (wave) of samples and adds them to the frame's sum of samples. Returns false once the sum
    // contains all samples of the plan.
    virtual bool advance() = 0;
    // Returns the number of samples in the frame's sum.
    [[nodiscard]] virtual std::uint32_t samples() const = 0;
    // Returns the number of samples that the frame's sum will contain when the current plan is complete.
    [[nodiscard]] virtual std::uint32_t sampleTotal() const = 0;
    // Returns the frame's sum divided by samples(): linear, premultiplied RGBA, row 0 at the top. Needs at least one
    // sample.
    [[nodiscard]] virtual Image image() = 0;
    // Returns the sum of the latest block of 64 samples, which may be incomplete; nullopt for methods that do not sum
    // lens samples.
    [[nodiscard]] virtual std::optional<BlockSum> blockSum() { return {}; }
    // Returns the depth in m of the first sample of the latest batch (wave), +∞ where no surface writes depth; nullopt
    // for methods that do not sum lens samples. Not available if the plan draws only a tile of the image
    // (FramePlan::tile).
    [[nodiscard]] virtual std::optional<Image> sampleDepth() { return {}; }
    // Returns the data layers (RenderSettings::layers) of all samples so far; nullopt without layers, and for methods
    // that draw none (Method::drawsLayers).
    [[nodiscard]] virtual std::optional<LayerImages> layerImages() { return {}; }
    [[nodiscard]] virtual RenderStats stats() const = 0;

    // Adds the samples of `plan`, which must have the same view, to the sum as further blocks. All samples of earlier
    // plans must have been drawn and form complete blocks of 64. Methods that do not sum blocks (Method::sumsBlocks)
    // start a new frame instead. Afterwards, the times in stats() cover only `plan`; triangles and samples are totals.
    virtual void continueWith(const FramePlan& plan) { start(plan); }
    // Limits the number of samples that are drawn together, from the next start() on. The image is the same for any
    // limit.
    virtual void setWave(const WaveLimit& /*limit*/) {}
    // Returns image() as a texture with row 0 at the bottom, valid until the next call of a member function; nullptr
    // for methods without OpenGL.
    [[nodiscard]] virtual const GlTexture* imageTexture() { return nullptr; }
};

inline void drawAllSamples(Renderer& renderer, const FramePlan& plan) {
    renderer.start(plan);
    while (renderer.advance()) {
    }
}

// Draws all samples of the plan and returns the image.
inline Image imageOf(Renderer& renderer, const FramePlan& plan) {
    drawAllSamples(renderer, plan);
    return renderer.image();
}

}  // namespace defocus::engine
