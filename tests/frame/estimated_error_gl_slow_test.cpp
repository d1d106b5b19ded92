// Compares the estimated error of frames with the true error against a converged reference at full detail. The scenes
// are models of this project, the school of fish and two public models. Levels of detail are on, and their error is
// part of the true error.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "defocus/defocus.h"
#include "frame/driver/reference_image.h"
#include "frame/own_context.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "models.h"
#include "render/accumulation/accumulation.h"
#include "render/frame_run.h"

namespace defocus::engine {
namespace {

constexpr std::uint32_t referenceSamples = 3072;
constexpr double agreement = 1.5;

struct StoppedFrame {
    Image image;
    RenderStats stats;
};

StoppedFrame stoppedFrame(const PreparedFrame& frame, Renderer& renderer, const StopSettings& stop) {
    FrameRun run(frame.world, renderer);
    run.start(frame.view, frame.settings, stop);
    while (run.advance()) {
    }
    return {renderer.image(), run.stats()};
}

class EstimatedError : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        SKIP_ON_SECOND_DRIVER();
        try {
            context_ = createHeadlessContext();
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        Request request;
        request.size.width = 96;
        request.size.height = 72;
        request.trianglesPerFish = 2'000;
        request.noCache = true;
        request.lens.fStop = 0.95;
        request.lod = LodMode::fractional;
        if (GetParam() != "school") request.scene = modelPath(GetParam());
        if (!request.scene.empty() && !std::filesystem::exists(request.scene))
            GTEST_SKIP() << request.scene << " does not exist";
        frame_ = prepareFrame(request);
        renderer_ = makeAccumulationRenderer(frame_.world, {});
    }

    std::unique_ptr<GlContext> context_;
    PreparedFrame frame_;
    std::unique_ptr<Renderer> renderer_;
};

TEST_P(EstimatedError, isWithinAFactorOfOneAndAHalfOfTheTrueOne) {
    ReferenceOptions options;
    options.samples = referenceSamples;
    const ReferenceImage reference = renderedReference(frame_.world, frame_.view, options);
    const double first = stoppedFrame(frame_, *renderer_, {.targetError = 1, .timeLimit = {}, .sampleLimit = 128})
                             .stats.estimatedError.value();
    int judged = 0;
    fmt::print("{}: target, samples, RMSE estimated and true\n", GetParam());
    for (const double share : {1.0, 0.7, 0.5, 0.4}) {
        const double target = share * first;
        const StoppedFrame frame =
            stoppedFrame(frame_, *renderer_, {.targetError = target, .timeLimit = {}, .sampleLimit = 768});
        const double difference = compareImages(reference.image, frame.image, {}).rmse;
        // skip: the reference is too noisy to judge this image
        if (reference.remaining.rmse > 0.5 * difference) continue;
        const double trueError = std::sqrt(difference * difference - std::pow(reference.remaining.rmse, 2));
        const double ratio = frame.stats.estimatedError.value() / trueError;
        fmt::print("{:>9.5f} {:>6} {:>9.5f} {:>9.5f} {:>6.2f}\n", target, frame.stats.samples,
                   *frame.stats.estimatedError, trueError, ratio);
        EXPECT_GT(ratio, 1 / agreement) << frame.stats.samples;
        EXPECT_LT(ratio, agreement) << frame.stats.samples;
        ++judged;
    }
    EXPECT_GE(judged, 2);
}

TEST_P(EstimatedError, targetIsReachedWithTheSameSamplesEachTime) {
    const StoppedFrame some = stoppedFrame(frame_, *renderer_, {.targetError = 1, .timeLimit = {}, .sampleLimit = 128});
    const double target = 0.8 * some.stats.estimatedError.value();
    const StopSettings stop{.targetError = target, .timeLimit = {}, .sampleLimit = 4096};
    const StoppedFrame once = stoppedFrame(frame_, *renderer_, stop);
    EXPECT_EQ(once.stats.stopped, StopReason::targetError);
    EXPECT_LE(once.stats.estimatedError.value(), target);
    EXPECT_GE(once.stats.samples, 128u);
    EXPECT_LE(once.stats.samples, 1024u);
    const StoppedFrame again = stoppedFrame(frame_, *renderer_, stop);
    EXPECT_EQ(again.stats.samples, once.stats.samples);
    EXPECT_EQ(again.stats.trianglesDrawn, once.stats.trianglesDrawn);
    EXPECT_TRUE(again.image.pixels == once.image.pixels);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EstimatedError,
                         testing::Values("school", "meshes/bokeh.gltf", "meshes/chess.glb", "meshes/thicket.gltf",
                                         "meshes/staircase.gltf", "meshes/swimmers.glb"),
                         [](const auto& scene) { return testNameOf(scene.param); });

}  // namespace
}  // namespace defocus::engine
