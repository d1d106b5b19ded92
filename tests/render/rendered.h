#pragma once
// Whole images from a renderer: all samples of a plan, drawn.

#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus::engine {

inline Image imageOf(Renderer& renderer, const FramePlan& plan) {
    renderer.start(plan);
    while (renderer.advance()) {
    }
    return renderer.image();
}

// That of a method as the command line has it, without rounding of its layers to half floats.
inline Image imageByMethod(const char* method, const World& world, const FramePlan& plan) {
    const MethodUse use = parseMethodUse(method);
    RendererOptions options;
    options.layerFormat = LayerFormat::rgba32f;
    options.settings = completeSettings(use.method->name, use.method->settings, use.settings);
    return imageOf(*use.method->make(world, options), plan);
}

// The accumulation's, without rounding of its layers to half floats.
inline Image imageInFloats(const World& world, const FramePlan& plan) {
    RendererOptions options;
    options.layerFormat = LayerFormat::rgba32f;
    return imageOf(*methodNamed("accumulation").make(world, options), plan);
}

}  // namespace defocus::engine
