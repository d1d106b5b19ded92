#pragma once
// Scenes and settings for the tests of multirate rendering.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "plan/lens_cells/rates.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

inline RenderSettings ratedSettings(std::uint32_t samples, LodMode lod = LodMode::off) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = lod;
    if (lod != LodMode::off) settings.thresholds = {0.5, 2};
    return settings;
}

// Makes a renderer of `method`, given with its settings as on the command line.
inline std::unique_ptr<Renderer> rendererOf(const char* method, const World& world, RendererOptions options = {}) {
    const MethodUse use = parseMethodUse(method);
    options.settings = use.settings;
    return use.method->make(world, options);
}

inline Image drawnBy(const char* method, const SmallWorld& small, const RenderSettings& settings,
                     const RendererOptions& options = {}) {
    return imageOf(*rendererOf(method, small.world, options), planFrame(small.world, small.view, settings));
}

// Samples share images only where lens cells do not blur them, so cells are off.
inline constexpr const char* sharing = "multirate:cells=off";

// Reference image by samples that differ from those of the images under test.
inline Image convergedImage(const SmallWorld& small) {
    RenderSettings settings = ratedSettings(4096);
    settings.sequence = Sequence::halton;
    settings.firstSample = 1u << 20;
    return drawnBy("accumulation", small, settings);
}

// Returns the largest relative difference of a pixel from one colour.
inline double relativeDifferenceFrom(const Image& image, const glm::vec3& color) {
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
        for (glm::length_t c = 0; c < 3; ++c) {
            const double off =
                std::abs(double{image.pixels[i * 4 + static_cast<std::size_t>(c)]} / double{color[c]} - 1);
            if (!(off <= largest)) largest = off;  // true for NaN, too
        }
    return largest;
}

// Five spheres of which only some are shared.
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
        std::ranges::count_if(frameRates(plan, false).objects, [](const ObjectRates& o) { return o.lensShare > 0; }));
}

}  // namespace defocus::engine
