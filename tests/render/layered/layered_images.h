#pragma once
// Helpers that render images with method "layered" and compute the difference of two images.

#include <gtest/gtest.h>

#include "gl_context_test.h"
#include "likeness.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

using Layered = GlContextTest;

inline RenderSettings samplesOf(std::uint32_t samples) {
    // keepAll: draw with the lens instead of a pinhole even if nothing is visibly blurred
    return {.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
}

inline Image seenBy(const SmallWorld& small, const char* method, std::uint32_t samples = 256,
                    RendererOptions options = {}) {
    const MethodUse use = parseMethodUse(method);
    options.settings = use.settings;
    const auto renderer = use.method->make(small.world, options);
    return imageOf(*renderer, planFrame(small.world, small.view, samplesOf(samples)));
}

}  // namespace defocus::engine
