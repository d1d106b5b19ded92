#pragma once
// Whole images from a renderer: all samples of a plan, drawn.

#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus {

inline Image imageOf(Renderer& renderer, const FramePlan& plan) {
    renderer.start(plan);
    while (renderer.advance()) {
    }
    return renderer.image();
}

// The accumulation's, without rounding of its layers to half floats.
inline Image imageInFloats(const World& world, const FramePlan& plan) {
    RendererOptions options;
    options.layerFormat = LayerFormat::rgba32f;
    return imageOf(*methodNamed("accumulation").make(world, options), plan);
}

}  // namespace defocus
