// Tests that a target error or a time limit ends a frame before its max number of samples. Both are rejected if they
// are invalid or if the request's method or motion blur cannot end early.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "defocus/defocus.h"
#include "frame/own_context.h"

namespace defocus::engine {
namespace {

Request twoFish() {
    Request request;
    request.fishCount = 2;
    request.trianglesPerFish = 2'000;
    request.noCache = true;
    request.size.width = 64;
    request.size.height = 48;
    request.lens.fStop = 1;
    request.samples = 64;
    return request;
}

class StoppedRender : public OwnContextTest {};

TEST_F(StoppedRender, statisticsSayWhyAndHowFarOff) {
    Request request = twoFish();
    SceneRenderer renderer(request);
    static_cast<void>(renderer.render());
    EXPECT_EQ(renderer.statistics().samples, 64u);
    EXPECT_EQ(renderer.statistics().stopped, StopReason::sampleCount);
    EXPECT_FALSE(renderer.statistics().estimatedError);

    request.samples.reset();
    request.targetError = 0.05;
    static_cast<void>(renderer.render(request));
    EXPECT_EQ(renderer.statistics().samples, 128u);
    EXPECT_EQ(renderer.sampleTotal(), 128u);
    EXPECT_EQ(renderer.statistics().stopped, StopReason::targetError);
    EXPECT_LE(renderer.statistics().estimatedError.value(), 0.05);
    EXPECT_GT(renderer.statistics().trianglesDrawn, 0u);

    request.targetError.reset();
    request.timeLimit = 1e-3;
    static_cast<void>(renderer.render(request));
    EXPECT_EQ(renderer.statistics().samples, 64u) << "at least one block; the next would end too late";
    EXPECT_EQ(renderer.statistics().stopped, StopReason::timeLimit);

    request.targetError = 1e-6;
    request.timeLimit.reset();
    request.samples = 256;
    request.lens.dofEnabled = false;
    static_cast<void>(renderer.render(request));
    EXPECT_EQ(renderer.statistics().stopped, StopReason::nothingBlurred);
    EXPECT_LT(renderer.statistics().samples, 64u);
}

// At full detail, a frame drawn block by block towards a target error is bit-identical to a frame with the same fixed
// number of samples.
TEST_F(StoppedRender, blocksMakeTheImageOfAsManySamples) {
    Request request = twoFish();
    request.lod = LodMode::off;
    request.samples = 200;
    const Image fixed = render(request);
    request.targetError = 1e-6;
    EXPECT_TRUE(render(request).pixels == fixed.pixels);
}

TEST_F(StoppedRender, whatCannotBeFollowedIsRefused) {
    Request request = twoFish();
    request.targetError = 0.01;
    request.method = "circular";
    EXPECT_THROW(static_cast<void>(render(request)), UsageError);
    request = twoFish();
    request.timeLimit = 1;
    request.shutter = 0.1;
    request.motionSegments = ExactMotion{};
    EXPECT_THROW(static_cast<void>(render(request)), UsageError);
    for (const double wrong : {0.0, -1.0, 2.0, std::nan("")}) {
        request = twoFish();
        request.targetError = wrong;
        EXPECT_THROW(static_cast<void>(render(request)), UsageError) << wrong;
    }
    request = twoFish();
    request.samples = 0;
    EXPECT_THROW(static_cast<void>(render(request)), UsageError);
}

}  // namespace
}  // namespace defocus::engine
