#pragma once
// One interface, many methods. Render, bench, capture and view are thin loops over it:
//   renderer.start(plan); while (renderer.advance()) {} Image image = renderer.image();

#include <cstdint>
#include <optional>
#include <string>

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus {

struct RenderStats {
    std::uint32_t samples = 0;
    double setupMilliseconds = 0;   // uploads and shader builds of this renderer
    double renderMilliseconds = 0;  // the frame, from start() to its finished sum
    double gpuMilliseconds = 0;     // timer queries; on a software driver these miss vertex work
    std::uint64_t trianglesDrawn = 0;
    std::uint64_t peakBytes = 0;  // GPU resources held by this renderer, at their peak
    std::uint32_t wave = 0;       // K, lens samples drawn at once
    std::string layerFormat;      // of the layers, e.g. "rgb9e5", "rgba16f"
    std::string device;
    std::string driver;
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
};

}  // namespace defocus
