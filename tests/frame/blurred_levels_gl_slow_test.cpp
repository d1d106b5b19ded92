// Tests errors of levels of detail that remain visible under a wide blur, by comparing the mean radiance of boxes of 32
// × 32 px.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "frame/driver/reference_image.h"
#include "frame/own_context.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/boxes.h"
#include "models.h"
#include "render/accumulation/accumulation.h"
#include "render/frame_run.h"

namespace defocus::engine {
namespace {

constexpr int boxSize = 32;  // px

class BlurredLevels : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        SKIP_ON_SECOND_DRIVER();
        try {
            context_ = createHeadlessContext();
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        Request request;
        request.scene = modelPath(GetParam());
        if (!std::filesystem::exists(request.scene)) GTEST_SKIP() << request.scene << " does not exist";
        request.size.width = 384;
        request.size.height = 288;
        request.noCache = true;
        request.lens.fStop = 0.95;
        request.lod = LodMode::fractional;
        frame_ = prepareFrame(request);
    }

    Image image(LodMode lod) {
        RenderSettings settings = frame_.settings;
        settings.sampleCount = 64;
        settings.lod = lod;
        const auto renderer = makeAccumulationRenderer(frame_.world, {});
        FrameRun run(frame_.world, *renderer);
        run.start(frame_.view, settings, {});
        while (run.advance()) {
        }
        triangles_ = run.stats().trianglesDrawn;
        return renderer->image();
    }

    std::unique_ptr<GlContext> context_;
    PreparedFrame frame_;
    std::uint64_t triangles_ = 0;  // triangles drawn for the last image
};

// With fractional levels of detail, the error of the mean radiance of boxes of 32 × 32 px is at most three times the
// error at full detail, both with 64 samples. The focus distance is first automatic and then four times as large, which
// blurs the whole model.
TEST_P(BlurredLevels, errAfterBoxesByNoMoreThanThreeTimesTheSamples) {
    const double focus = frame_.view.lens.focusDistance;
    bool drawsLevels = false;
    for (const double distance : {focus, 4 * focus}) {
        frame_.view.lens.focusDistance = distance;
        ReferenceOptions options;
        options.samples = 512;
        const Image reference = renderedReference(frame_.world, frame_.view, options).image;
        const double full = boxDifference(reference, image(LodMode::off), boxSize);
        const std::uint64_t all = triangles_;
        const double levels = boxDifference(reference, image(LodMode::fractional), boxSize);
        fmt::print("{}, focus at {:.3g} m: {:.2f} times full detail's {:.1e}, of {:.0f} % of its triangles\n",
                   GetParam(), distance, levels / full, full,
                   100 * static_cast<double>(triangles_) / static_cast<double>(all));
        EXPECT_LE(levels, 3 * full) << "focus at " << distance << " m";
        EXPECT_LE(triangles_, all);
        drawsLevels |= triangles_ < all;
    }
    // Only the Japanese garden may be drawn at full detail, since its triangles are larger than its blur.
    EXPECT_TRUE(drawsLevels || GetParam().starts_with("japanese")) << "levels must be drawn";
}

INSTANTIATE_TEST_SUITE_P(Scenes, BlurredLevels,
                         testing::Values("FlightHelmet/FlightHelmet.gltf", "WaterBottle.glb", "meshes/fish.glb",
                                         "japanese-bridge-garden-meshopt.glb"),
                         [](const auto& scene) { return testNameOf(scene.param); });

}  // namespace
}  // namespace defocus::engine
