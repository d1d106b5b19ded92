#pragma once
// Functions that render images of scenes at full detail with the ray tracer.

#include <cstdint>

#include "bokeh.h"
#include "embree/embree_renderer.h"

namespace defocus::engine {

inline FramePlan planOf(const View& view, std::uint32_t samples) {
    FramePlan plan;
    plan.view = view;
    plan.settings.sampleCount = samples;
    return plan;
}

inline Image traced(const Scene& scene, const View& view, std::uint32_t samples,
                    const Environment& environment = blackBackground(),
                    EmbreeSampling sampling = EmbreeSampling::perPixel) {
    const World world = flatWorld(scene, environment);
    return imageOf(*makeEmbreeRenderer(world, sampling), planOf(view, samples));
}

}  // namespace defocus::engine
