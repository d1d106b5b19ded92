#pragma once
// Functions that render images with all samples of a plan.

#include "plan/frame_plan.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"

namespace defocus::engine {

// Renders an image with 32-bit float layers. `method` is written as on the command line, for example "line:segments=4".
inline Image imageByMethod(const char* method, const World& world, const FramePlan& plan) {
    const MethodUse use = parseMethodUse(method);
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f,
                                  .settings = completeSettings(use.method->name, use.method->settings, use.settings)};
    return imageOf(*use.method->make(world, options), plan);
}

// Renders an image with method "accumulation" and 32-bit float layers.
inline Image imageInFloats(const World& world, const FramePlan& plan) {
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    return imageOf(*makeAccumulationRenderer(world, options), plan);
}

}  // namespace defocus::engine
