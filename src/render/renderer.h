#pragma once
// One interface, many methods. Render, bench, capture and view are thin loops over it:
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
    double milliseconds = 0;  // timer queries, over all waves of the frame
};

// A figure of one method alone.
struct MethodFigure {
    std::string name;
    double value = 0;
};

struct RenderStats {
    std::uint32_t samples = 0;
    double setupMilliseconds = 0;       // uploads and shader builds of this renderer
    double renderMilliseconds = 0;      // the frame, from start() to its finished sum
    double gpuMilliseconds = 0;         // timer queries; on a software driver these miss vertex work
    std::uint64_t trianglesDrawn = 0;   // of the plan
    std::uint64_t trianglesHidden = 0;  // of these, left out behind others
    std::uint64_t peakBytes = 0;        // GPU resources held by this renderer, at their peak
    std::uint32_t wave = 0;             // K, lens samples drawn at once
    std::string layerFormat;            // of the layers, e.g. "rgb9e5", "rgba16f"
    std::string device;
    std::string driver;
    StopReason stopped = StopReason::sampleCount;  // why there are no more samples
    std::optional<double> estimatedError;          // RMSE as StopSettings has it, where it was estimated
    std::vector<MethodFigure> figures;             // that the method reports of itself
    std::vector<PassTime> passes;                  // of methods that time them, in the order they run
};

// The sum of the samples of one block (64, the frame's last one fewer), RGBA: the value and what its additions lost,
// which together are the sum. For frames that several machines share.
struct BlockSum {
    std::uint32_t samples = 0;
    Image sum;
    Image compensation;
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // Begins a frame. The plan is copied; it must come from the World that this renderer was made for.
    virtual void start(const FramePlan& plan) = 0;
    // Draws one wave of samples; false once all samples of the plan are in the sum.
    virtual bool advance() = 0;
    // Samples in the sum so far.
    [[nodiscard]] virtual std::uint32_t samples() const = 0;
    // Samples in the sum once the frame that was started is done.
    [[nodiscard]] virtual std::uint32_t sampleTotal() const = 0;
    // The sum divided by samples(): linear, RGBA premultiplied, row 0 at the top. At least one sample must be in.
    [[nodiscard]] virtual Image image() = 0;
    // The block that the last wave belongs to, as far as it is summed; nothing for methods that sum no lens samples.
    [[nodiscard]] virtual std::optional<BlockSum> blockSum() { return {}; }
    [[nodiscard]] virtual RenderStats stats() const = 0;

    // More samples of the same view: adds those of `plan` to the sum as further blocks. The samples of the plans before
    // must all be in, in whole blocks of 64. Methods that don't sum blocks (Method::sumsBlocks) begin anew. Times and
    // setupMilliseconds of stats() are then those of this plan, its triangles and samples those of the sum.
    virtual void continueWith(const FramePlan& plan) { start(plan); }
    // K from the next start() on; 0: as the options said. The image is the same.
    virtual void setWave(std::uint32_t /*samples*/) {}
    // image() on the GPU, row 0 at the bottom; valid until the next call of any member. Null for methods without GL.
    [[nodiscard]] virtual const GlTexture* imageTexture() { return nullptr; }
};

}  // namespace defocus::engine
