#pragma once
// The common interface of all methods. Render, bench, capture and view are thin loops over it:
//   renderer.start(plan); while (renderer.advance()) {} Image image = renderer.image();

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

class GlTexture;

struct PassTime {
    std::string name;
    double milliseconds = 0;  // timer queries, summed over all waves of the frame
};

// A statistic that only one method reports.
struct MethodFigure {
    std::string name;
    double value = 0;
};

struct RenderStats {
    std::uint32_t samples = 0;
    double setupMilliseconds = 0;       // uploads and shader builds of this renderer
    double renderMilliseconds = 0;      // from start() to the finished sum of the frame
    double gpuMilliseconds = 0;         // timer queries; software drivers omit vertex work
    std::uint64_t trianglesDrawn = 0;   // triangles of the plan
    std::uint64_t trianglesHidden = 0;  // triangles of the plan skipped because others hide them
    std::uint64_t peakBytes = 0;        // peak of the GPU resources of this renderer
    std::uint32_t wave = 0;             // K, lens samples drawn at once
    std::string layerFormat;            // of the layers, e.g. "rgba16f"
    std::string device;
    std::string driver;
    StopReason stopped = StopReason::sampleCount;  // why no more samples were drawn
    std::optional<double> estimatedError;          // RMSE as defined in StopSettings, if estimated
    std::vector<MethodFigure> figures;             // reported by the method itself
    std::vector<PassTime> passes;                  // of methods that time them, in order of execution
};

// The sum of the samples of one block, RGBA: value and compensation, whose total is the exact sum. A block has 64
// samples; the frame's last one may have fewer. Used for frames that several machines share.
struct BlockSum {
    std::uint32_t samples = 0;
    Image sum;
    Image compensation;
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // Begins a frame. The plan is copied and must come from this renderer's World.
    virtual void start(const FramePlan& plan) = 0;
    // Draws one wave of samples. Returns false once all samples of the plan are in the sum.
    virtual bool advance() = 0;
    // Number of samples in the sum so far.
    [[nodiscard]] virtual std::uint32_t samples() const = 0;
    // Number of samples in the sum once the current frame is finished.
    [[nodiscard]] virtual std::uint32_t sampleTotal() const = 0;
    // Returns the sum divided by samples(): linear, premultiplied RGBA, row 0 at the top. Needs at least one sample.
    [[nodiscard]] virtual Image image() = 0;
    // Returns the sum of the block of the last wave, finished or not. Empty for methods that sum no lens samples.
    [[nodiscard]] virtual std::optional<BlockSum> blockSum() { return {}; }
    [[nodiscard]] virtual RenderStats stats() const = 0;

    // Continues with more samples of the same view: adds those of `plan` to the sum as further blocks. All samples of
    // earlier plans must be drawn, in complete blocks of 64. Methods that don't sum blocks (Method::sumsBlocks) start
    // over. In stats(), times are then those of this plan; triangles and samples are those of the sum.
    virtual void continueWith(const FramePlan& plan) { start(plan); }
    // Sets K from the next start() on; 0 restores the value of the options. The image stays the same.
    virtual void setWave(std::uint32_t /*samples*/) {}
    // Returns image() as a texture, row 0 at the bottom. Valid until the next call of any member. Null for methods
    // without GL.
    [[nodiscard]] virtual const GlTexture* imageTexture() { return nullptr; }
};

}  // namespace defocus::engine
