#pragma once
// What the tests of multirate rendering draw, and with which settings.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "plan/rates.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus {

inline RenderSettings ratedSettings(std::uint32_t samples, LodMode lod = LodMode::off) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = lod;
    if (lod != LodMode::off) settings.thresholds = {0.5, 2};
    return settings;
}

inline Image drawnBy(const char* method, const SmallWorld& small, const RenderSettings& settings,
                     const RendererOptions& options = {}) {
    return imageOf(*methodNamed(method).make(small.world, options), planFrame(small.world, small.view, settings));
}

// Some of the spheres share, and some don't.
inline std::unique_ptr<SmallWorld> partlyShared() {
    auto small = fiveSpheres();
    small->view.lens.fStop = 1.2;
    small->view.width = 120;
    small->view.height = 90;
    return small;
}

inline std::size_t sharingObjects(const SmallWorld& small, const RenderSettings& settings) {
    const FramePlan plan = planFrame(small.world, small.view, settings);
    return static_cast<std::size_t>(
        std::ranges::count_if(frameRates(plan).objects, [](const ObjectRates& o) { return o.lensShare > 0; }));
}

}  // namespace defocus
