// Tests that methods "accumulation" and "multirate" give the same image for any wave size, which is the number of
// samples drawn together. Also tests the rounding error of the sum of samples.

#include <algorithm>
#include <cmath>
#include <vector>

#include "gl_conduct.h"
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

// The sum of samples on the GPU, with compensated rounding, agrees with a sum of the same samples in double precision.
TEST_F(Accumulation, summationErrsLessThanOneInAMillion) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = fiveSpheres();
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const std::uint32_t n = 150;
    std::vector<double> sum;
    for (std::uint32_t i = 0; i < n; ++i) {
        RenderSettings one = settingsFor(1, LodMode::off);
        one.firstSample = i;
        one.keepAll = true;
        FramePlan plan = planFrame(small->world, small->view, one);
        plan.frameSamples = n;  // the filter that widens highlights depends on the frame's sample count
        const Image layer = imageOf(*methodNamed("accumulation").make(small->world, options), plan);
        sum.resize(layer.pixels.size());
        for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += double(layer.pixels[p]);
    }
    RenderSettings all = settingsFor(n, LodMode::off);
    all.keepAll = true;
    const Image image = rendered(*small, all, options);
    double worst = 0;
    for (std::size_t p = 0; p < sum.size(); ++p)
        if (sum[p] > 1e-3) worst = std::max(worst, std::abs(image.pixels[p] * double(n) / sum[p] - 1));
    EXPECT_LT(worst, 1e-6);
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
