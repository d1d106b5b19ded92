// Tests the foreground blur limit against an independent ray tracer that puts a separate lens in front of each pixel
// (Munkberg, Toth and Akenine-Möller 2012, Figure 9).

#include <gtest/gtest.h>

#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "lens/circle_of_confusion.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "truth_scene.h"

namespace defocus::engine {
namespace {

constexpr double limit = 5;  // max diameter of the circle of confusion in front of the focus plane, px

// Returns a small school of fish. Without a foreground limit, the blur of its nearest fish is more than three times as
// large as `limit`.
std::unique_ptr<TruthScene> nearSchool() {
    FishSchoolOptions school;
    school.fishCount = 8;
    school.trianglesPerFish = 2000;
    auto baked = truthScene(fishSchool(school), 200, 150);
    baked->view.lens.focusDistance *= 1.6;
    baked->view.lens.fStop /= 4;
    return baked;
}

Image rasterised(const TruthScene& baked, const RenderSettings& settings) {
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    return imageOf(*makeAccumulationRenderer(baked.world, options), planFrame(baked.world, baked.view, settings));
}

Image traced(const TruthScene& baked, const RenderSettings& settings, EmbreeSampling sampling) {
    return imageOf(*makeEmbreeRenderer(baked.world, sampling), planFrame(baked.world, baked.view, settings));
}

TEST(TruthLimited, foregroundIsThatOfALensBeforeEveryPixel) {
    SKIP_ON_SECOND_DRIVER();
    const auto context = createHeadlessContext();
    const auto baked = nearSchool();
    RenderSettings settings = fullDetailSettings(128);
    settings.cocTolerance = 0.05;
    const FramePlan plan = planFrame(baked->world, baked->view, settings);
    double largest = 0;
    for (const ObjectPlan& object : plan.objects) largest = std::max(largest, -object.coc.nearest);
    ASSERT_GT(largest, 3 * limit) << "the limit must matter";
    const Image unlimited = rasterised(*baked, settings);
    baked->view.lens.foregroundLimit = limit;
    const Image image = rasterised(*baked, settings);
    const Image planned = traced(*baked, settings, EmbreeSampling::planned);
    EXPECT_GT(compareImages(planned, image).psnr, 60);
    EXPECT_GT(compareImages(traced(*baked, settings, EmbreeSampling::perPixel), image).psnr, 45);
    EXPECT_LT(compareImages(planned, unlimited).psnr, 35) << "the unlimited image differs";
}

}  // namespace
}  // namespace defocus::engine
