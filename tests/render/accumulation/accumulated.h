#pragma once
// Fixtures that render images with method "accumulation", which averages images over lens samples.

#include <gtest/gtest.h>

#include "gl_context_test.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class Accumulation : public GlContextTest {
protected:
    static RenderSettings settingsFor(std::uint32_t samples, LodMode lod = LodMode::fractional) {
        return {.sampleCount = samples, .lod = lod, .thresholds = {0.5, 2}};
    }

    static Image rendered(const SmallWorld& small, const RenderSettings& settings,
                          const RendererOptions& options = {}) {
        const auto renderer = makeAccumulationRenderer(small.world, options);
        return imageOf(*renderer, planFrame(small.world, small.view, settings));
    }
};

// Fixture for images in which one sample may draw two levels of detail of an object, each in some of the pixels
// (LodMode::continuous).
class ScreenDoor : public GlContextTest {
protected:
    static RenderSettings continuousFor(std::uint32_t samples) {
        return {.sampleCount = samples, .lod = LodMode::continuous, .thresholds = {0.5, 2}};
    }

    static Image renderedPlan(const SmallWorld& small, const FramePlan& plan, RendererOptions options = {}) {
        if (options.layerFormat == LayerFormat::automatic) options.layerFormat = LayerFormat::rgba32f;
        const auto renderer = makeAccumulationRenderer(small.world, options);
        return imageOf(*renderer, plan);
    }
};

}  // namespace defocus::engine
