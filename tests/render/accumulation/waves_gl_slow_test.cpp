// Tests that methods "accumulation" and "multirate" give the same image for any wave size, which is the number of
// samples drawn together.

#include <algorithm>

#include "likeness.h"
#include "render/accumulation/accumulated.h"
#include "render/accumulation/lens_cell_renders.h"

namespace defocus::engine {
namespace {

TEST_F(Accumulation, waveSizeChangesNoBit) {
    const auto small = fiveSpheres();
    small->view.width = 80;
    small->view.height = 60;
    for (const LayerFormat format : {LayerFormat::rgba16f, LayerFormat::rgba32f}) {
        Image first;
        for (const std::uint32_t k : {1u, 3u, 64u}) {
            const RendererOptions options{.layerFormat = format, .wave = k};
            const Image image = rendered(*small, settingsFor(70), options);
            if (first.empty())
                first = image;
            else
                EXPECT_TRUE(sameBits(first, image)) << "K = " << k << ": " << largestDifference(first, image);
        }
    }
}

int sharingObjects(const FramePlan& plan) {
    return static_cast<int>(std::count_if(plan.objects.begin(), plan.objects.end(),
                                          [](const ObjectPlan& object) { return boundarySample(object).has_value(); }));
}

TEST_F(ScreenDoor, waveSizeChangesNoBit) {
    const auto small = fiveSpheres();
    small->view.width = 80;
    small->view.height = 60;
    const FramePlan plan = planFrame(small->world, small->view, continuousFor(70));
    ASSERT_GE(sharingObjects(plan), 2);
    for (const LayerFormat format : {LayerFormat::rgba16f, LayerFormat::rgba32f}) {
        RendererOptions options{.layerFormat = format, .wave = 1};
        const Image first = renderedPlan(*small, plan, options);
        for (const std::uint32_t k : {3u, 64u}) {
            options.wave = k;
            EXPECT_TRUE(sameBits(first, renderedPlan(*small, plan, options))) << "K = " << k;
        }
    }
}

TEST_F(LensCellImages, waveSizeChangesNoBit) {
    const auto small = blurredSpheres();
    for (const std::uint32_t samples : {64u, 200u}) {
        const RenderSettings settings = ratedSettings(samples, LodMode::continuous);
        ASSERT_GT(lensCellsOf(*small, settings).classes(), 1);
        for (const LayerFormat format : {LayerFormat::rgba16f, LayerFormat::rgba32f}) {
            Image first;
            for (const std::uint32_t k : {1u, 3u, 64u}) {
                const RendererOptions options{.layerFormat = format, .wave = k};
                const Image image = drawnBy("multirate", *small, settings, options);
                if (first.empty()) first = image;
                EXPECT_TRUE(sameBits(first, image)) << "K = " << k << ": " << largestDifference(first, image);
            }
        }
    }
}

}  // namespace
}  // namespace defocus::engine
