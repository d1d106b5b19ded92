// Tests PopCheck, which measures how visibly a shot's images change when objects change their level of detail.

#include <gtest/gtest.h>

#include "capture/pop_check.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "render/pops/level_change.h"

namespace defocus::engine {
namespace {

class PopChecks : public testing::Test {
protected:
    void SetUp() override {
        Request request;
        request.fishCount = 2;
        request.trianglesPerFish = 2000;
        request.size = {96, 72};
        frame_ = placeFrame(request);
        addPyramids(frame_);
    }

    FramePlan planAt(double focusDistance, LodMode lod) {
        View view = frame_.view;
        view.lens.focusDistance = focusDistance;
        RenderSettings settings = frame_.settings;
        settings.sampleCount = 16;
        settings.lod = lod;
        return planFrame(frame_.world, view, settings);
    }

    // Returns the largest pop (image change caused by a switch of levels of detail) in a focus pull of five frames.
    std::optional<FramePop> popOf(LodMode lod) {
        PopCheck check(frame_.world, parseMethodUse("accumulation"), {});
        for (int i = 0; i < 5; ++i) check.note(10 + i, planAt(2.0 + 0.4 * i, lod));
        EXPECT_EQ(check.compared(), 4);
        return check.largest();
    }

    std::unique_ptr<GlContext> context_ = createHeadlessContext();
    PreparedFrame frame_;
};

TEST_F(PopChecks, splitSamplesPopLessThanOneLevel) {
    const auto nearest = popOf(LodMode::nearest), fractional = popOf(LodMode::fractional);
    ASSERT_TRUE(nearest && fractional);
    EXPECT_GT(nearest->rmse, 2 * fractional->rmse);
    EXPECT_TRUE(nearest->object.starts_with("Fish")) << nearest->object;
    EXPECT_GE(nearest->frame, 11);
    EXPECT_LE(nearest->frame, 14);
    EXPECT_GT(nearest->seedRmse, 0);
}

TEST_F(PopChecks, fullDetailHasNone) {
    EXPECT_FALSE(popOf(LodMode::off));
}

// A frame whose preceding frame is missing cannot be compared, so PopCheck measures no pop (change caused by a switch
// of levels) for it.
TEST_F(PopChecks, aGapInTheFramesIsNoPop) {
    PopCheck check(frame_.world, parseMethodUse("accumulation"), {});
    check.note(1, planAt(2, LodMode::nearest));
    check.note(3, planAt(4, LodMode::nearest));
    EXPECT_EQ(check.compared(), 0);
    EXPECT_FALSE(check.largest());
}

}  // namespace
}  // namespace defocus::engine
