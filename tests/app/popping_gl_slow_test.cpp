// No popping: across a focus pull and a dolly, split samples change the image from frame to frame by a small part of
// what whole levels do, over the stretch of the movement where levels change most (eval/popping.h says what is
// measured).
//
// One sample's step is √(c/w)/N of a whole level's for a blur of c px and a level's deviation of w px, here at most
// about 30/0.4 at N = 32: 0.27. Movements of 240 frames change at most three samples a frame: √3 times that, 0.5.

#include <gtest/gtest.h>

#include <algorithm>

#include "app/prepared_frame.h"
#include "core/error.h"
#include "eval/popping.h"
#include "gl/context.h"
#include "models.h"

namespace defocus {
namespace {

constexpr double mostOfALevel = 0.5;
constexpr double mostPop = 1.5 / 255;  // display values, root mean square over the objects' pixels

class NoPopping : public testing::TestWithParam<Movement> {
protected:
    static void SetUpTestSuite() {
        try {
            context_ = createHeadlessContext();
        } catch (const Error&) {
        }
    }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<GlContext> context_;

    void SetUp() override {
        if (!context_) GTEST_SKIP() << "no GL context";
        options_.width = 160;
        options_.height = 120;
        options_.noCache = true;
    }

    void expectNone() const {
        const PreparedFrame frame = prepareFrame(options_);
        PoppingOptions popping;
        popping.movements = {GetParam()};
        popping.sampleCounts = {32};
        popping.frames = 8;
        popping.pathFrames = 240;
        popping.plan = frame.settings;
        double nearest = 0;
        double fractional = 0;
        PoppingVisitor visitor;
        visitor.sampleStep = [](const SampleStep&) {};
        visitor.frames = [&](std::span<const PoppingFrame> frames) {
            for (const PoppingFrame& each : frames) {
                double& worst = each.mode == LodMode::nearest ? nearest : fractional;
                worst = std::max(worst, each.step.objects.rmse);
            }
        };
        measurePopping(frame.world, frame.view, popping, visitor);
        RecordProperty("nearest", std::to_string(nearest));
        RecordProperty("fractional", std::to_string(fractional));
        ASSERT_GT(nearest, 0.004) << "no level changes: the movement shows nothing";
        EXPECT_GT(fractional, 0);
        EXPECT_LT(fractional, mostOfALevel * nearest);
        EXPECT_LT(fractional, mostPop);
    }

    SceneOptions options_;
};
std::unique_ptr<GlContext> NoPopping::context_;

TEST_P(NoPopping, ofTheSchoolOfFish) {
    options_.fishCount = 6;
    options_.trianglesPerFish = 12'000;
    options_.lens["blurScale"] = 4;  // at this size of the image, for the blur of a large one
    expectNone();
}

TEST_P(NoPopping, ofTheFox) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    options_.path = path;
    // 576 triangles, 100 m long: few pixels and much blur bring its levels into play.
    options_.width = 32;
    options_.height = 24;
    options_.lens["fStop"] = 0.25;
    options_.lens["blurScale"] = 1000;
    options_.lodCocAtCentre = true;
    expectNone();
}

INSTANTIATE_TEST_SUITE_P(Movements, NoPopping, testing::Values(Movement::focusPull, Movement::dolly),
                         [](const auto& movement) {
                             return movement.param == Movement::dolly ? "dolly" : "focusPull";
                         });

}  // namespace
}  // namespace defocus
