#pragma once
// Images that several lens samples of a block share, as the frame loop of the accumulation sees them: they are drawn
// once, and the samples' layers start from them instead of from nothing. Or the samples are lens cells, and share
// nothing.

#include <cstdint>

#include "plan/frame_plan.h"
#include "plan/lens_cells/lens_cells.h"
#include "render/accumulation/layer_sum.h"
#include "render/gpu_scene/surface_pass.h"

namespace defocus::engine {

class SharedImages {
public:
    virtual ~SharedImages() = default;

    // The target that samples are summed in, and the passes that draw into it, are `sum` and those of `info`. All three
    // must outlive the drawing.
    virtual void prepareTarget(GpuScene& scene, const SurfacePassInfo& info, const LayerSum& sum) = 0;
    // Gives up what depends on the target, which isn't there any more.
    virtual void releaseTarget() = 0;
    // What follows is of this plan, which must outlive the drawing.
    virtual void prepareFrame(const FramePlan& plan) = 0;
    // Of this plan. Where images are blurred as lens cells, nothing is shared.
    [[nodiscard]] virtual const LensCells& cells() const = 0;
    // Begins the block of the plan's samples [first, first + count); `first` is a multiple of 64. Returns what these
    // samples draw by themselves: they are its samples, in an order of their own.
    virtual FramePlan prepareBlock(std::uint32_t first, std::uint32_t count) = 0;
    // Draws the images that the block's samples [first, first + count) share, as far as they aren't there yet. Returns
    // the triangles that were drawn.
    virtual std::uint64_t draw(std::uint32_t first, std::uint32_t count) = 0;
    // Copies them into the samples' layers, which are cleared.
    virtual void copyToLayers(std::uint32_t first, std::uint32_t count) const = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace defocus::engine
