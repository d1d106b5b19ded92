#pragma once
// Interface to images that several lens samples of a block share. They are drawn once, and the samples' layers start
// from copies of them. Alternatively the samples are blurred as lens cells and share no images.

#include <cstdint>

#include "plan/frame_plan.h"
#include "plan/lens_cells/lens_cells.h"
#include "render/accumulation/layer_sum.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

class SharedImages {
public:
    virtual ~SharedImages() = default;

    // Sets the target that samples are summed in (`sum`) and the settings of the passes that draw into it (`info`).
    // `scene`, `info` and `sum` must outlive the drawing.
    virtual void prepareTarget(GpuScene& scene, const SurfacePassInfo& info, const LayerSum& sum) = 0;
    // Releases resources that depend on the target; call it before the target is destroyed.
    virtual void releaseTarget() = 0;
    // Begins a frame of `plan`, which must outlive the drawing.
    virtual void prepareFrame(const FramePlan& plan) = 0;
    // Lens cells of the current plan. Plans with lens cells share no images.
    [[nodiscard]] virtual const LensCells& cells() const = 0;
    // Begins the block of the plan's samples [first, first + count); `first` is a multiple of 64. Returns a plan of the
    // draws that are not shared. Its samples are those of the block, possibly reordered.
    virtual FramePlan prepareBlock(std::uint32_t first, std::uint32_t count) = 0;
    // Draws the missing images that the block's samples [first, first + count) share. Returns the number of triangles
    // drawn.
    virtual std::uint64_t draw(std::uint32_t first, std::uint32_t count) = 0;
    // Copies the shared images into the cleared layers of samples [first, first + count).
    virtual void copyToLayers(std::uint32_t first, std::uint32_t count) const = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace defocus::engine
