#pragma once
// Helpers that render images for tests of method "multirate", which draws few samples and blurs each sample's image.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "gl_context_test.h"
#include "plan/lens_cells/lens_cells.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

inline RenderSettings ratedSettings(std::uint32_t samples, LodMode lod = LodMode::off) {
    RenderSettings settings{.sampleCount = samples, .lod = lod};
    if (lod != LodMode::off) settings.thresholds = {0.5, 2};
    return settings;
}

// Returns a renderer for `method`, written as on the command line, for example "line:segments=4".
inline std::unique_ptr<Renderer> rendererOf(const char* method, const World& world, RendererOptions options = {}) {
    const MethodUse use = parseMethodUse(method);
    options.settings = use.settings;
    return use.method->make(world, options);
}

inline Image drawnBy(const char* method, const SmallWorld& small, const RenderSettings& settings,
                     const RendererOptions& options = {}) {
    return imageOf(*rendererOf(method, small.world, options), planFrame(small.world, small.view, settings));
}

// Returns a reference image of 2,048 samples, whose sample sequence differs from that of the tested images.
inline Image convergedImage(const SmallWorld& small) {
    RenderSettings settings = ratedSettings(2048);
    settings.sequence = Sequence::halton;
    settings.firstSample = 1u << 20;
    return drawnBy("accumulation", small, settings);
}

// Returns the largest relative difference between a pixel of the image and `color`.
inline double relativeDifferenceFrom(const Image& image, const glm::vec3& color) {
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
        for (glm::length_t c = 0; c < 3; ++c) {
            const double off =
                std::abs(double{image.pixels[i * 4 + static_cast<std::size_t>(c)]} / double{color[c]} - 1);
            if (!(off <= largest)) largest = off;  // the negated comparison also records NaN
        }
    return largest;
}

// Fixture for images that are drawn with lens cells, which are regions of the lens. Each cell has one sample, whose
// image is blurred as a lens of the cell's size would blur it.
class LensCellImages : public GlContextTest {
protected:
    static LensCells lensCellsOf(const SmallWorld& small, const RenderSettings& settings) {
        return lensCells(planFrame(small.world, small.view, settings));
    }

    // Returns spheres in front of and behind the focal plane. With 64 samples, both sides have blur classes (groups of
    // pixels with similar blur) with σ = 1 and 2 px.
    static std::unique_ptr<SmallWorld> blurredSpheres() {
        auto small = fiveCoarseSpheres();
        small->view.lens.fStop = 0.125;
        return small;
    }
};

}  // namespace defocus::engine
