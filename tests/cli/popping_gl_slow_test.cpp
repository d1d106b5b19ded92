// Tests that fractional levels of detail avoid popping (visible image changes when objects switch levels) in a focus
// pull, a dolly and a walk cycle. Fractional levels divide an object's lens samples between two levels. From frame to
// frame, they change the image by a small fraction of a full change, in which all samples switch at once. The tests
// measure the section of each movement with the most level changes (measurements: eval/popping/popping.h).
//
// If one of N samples switches its level, the image changes by √(c/w)/N of a full change, for a blur of c px and a
// deviation of w px between the levels. Here c/w is at most about 30/0.4, so one sample changes the image by at most
// 8.7/N of a full change. If k samples of an object switch in the same frame, their changes add up like independent
// noise, to √k times the change of one sample. In movements of 480 frames, at most three of 64 samples switch per
// frame. In a walk at 24 frames per second, at most twelve of 128 samples switch; they change the image by up to 0.23
// of a full change.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "eval/popping/popping.h"
#include "frame/settings/presets.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "models.h"

namespace defocus::engine {
namespace {

constexpr double levelShareMax = 0.25;
constexpr double maxPop = 1.5 / 255;  // max RMS change of display values over the objects' pixels

class NoPopping : public testing::Test {
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
        options_.size.width = 160;
        options_.size.height = 120;
        options_.noCache = true;
        options_.lod = LodMode::fractional;
    }

    void expectNone(PoppingOptions popping, std::uint32_t samples) const {
        PreparedFrame frame = prepareFrame(options_);
        popping.sampleCounts = {samples};
        popping.plan = frame.settings;
        // Fixed thresholds make the levels independent of the sample count. The thresholds for 32 samples select levels
        // that are coarse enough for visible changes.
        popping.plan.metric = metric_;
        fixThresholds(popping.plan, 32);
        double nearest = 0;
        double fractional = 0;
        PoppingVisitor visitor;
        visitor.sampleStep = [](const SampleStep&) {};
        visitor.frames = [&](std::span<const PoppingFrame> frames) {
            for (const PoppingFrame& each : frames) {
                double& worst = each.mode == PoppingMode::nearest ? nearest : fractional;
                worst = std::max(worst, each.step.objects.rmse);
            }
        };
        measurePopping(frame.world, frame.view, popping, visitor);
        RecordProperty("nearest", std::to_string(nearest));
        RecordProperty("fractional", std::to_string(fractional));
        ASSERT_GT(nearest, minLevelPop_) << "levels must change during the movement";
        EXPECT_GT(fractional, 0);
        EXPECT_LT(fractional, levelShareMax * nearest);
        EXPECT_LT(fractional, maxPop);
    }

    // Expects no popping in the `frames` frames with the most level changes, out of a movement of 480 frames (20 s).
    void expectNoneAlong(Movement movement, int frames = 8) const {
        PoppingOptions popping;
        popping.movements = {movement};
        popping.frames = frames;
        popping.pathFrames = 480;
        expectNone(popping, 64);
    }

    void school() {
        options_.fishCount = 6;
        options_.trianglesPerFish = 12'000;
        options_.lens.blurScale = 4;  // gives this small image as many px of blur as a large one
    }

    // Selects a fox of 576 triangles, 100 m long, and a strong blur, so that coarse levels are drawn.
    void fox(const std::filesystem::path& path) {
        options_.scene = path;
        options_.units = 1;
        options_.clip = "Walk";
        options_.time = 0.3;  // time in s at which the fox is in mid-stride
        options_.lens.blurScale = 1000;
    }

    Request options_;
    LodMetric metric_ = LodMetric::size;
    double minLevelPop_ = 0.003;  // required RMSE if all samples switch levels; below it, the test would prove nothing
};
std::unique_ptr<GlContext> NoPopping::context_;

TEST_F(NoPopping, ofTheSchoolOfFishInAFocusPull) {
    school();
    expectNoneAlong(Movement::focusPull);
}

TEST_F(NoPopping, ofTheSchoolOfFishInADolly) {
    school();
    expectNoneAlong(Movement::dolly);
}

// The default metric selects levels that differ so little that even a switch of all samples is hardly visible.
TEST_F(NoPopping, ofLevelsByMeasuredErrorInAFocusPull) {
    school();
    metric_ = LodMetric::measured;
    minLevelPop_ = 0.0005;
    expectNoneAlong(Movement::focusPull, 3);
}

TEST_F(NoPopping, ofThePublishedPresetInAFocusPull) {
    school();
    applyPreset(presetNamed("jeong2011"), options_);
    metric_ = LodMetric::proportional;
    minLevelPop_ = 0.0005;
    expectNoneAlong(Movement::focusPull, 3);
}

TEST_F(NoPopping, ofTheFoxInAFocusPull) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    fox(path);
    options_.size.width = 32;
    options_.size.height = 24;
    options_.lens.fStop = 0.25;
    options_.lodCoc = LodCoc::centre;
    expectNoneAlong(Movement::focusPull);
}

TEST_F(NoPopping, ofTheFoxInADolly) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    fox(path);
    options_.size.width = 32;
    options_.size.height = 24;
    options_.lens.fStop = 0.25;
    options_.lodCoc = LodCoc::centre;
    expectNoneAlong(Movement::dolly);
}

// A walk cycle at 24 frames per second does not pop. The focus plane is in front of the fox. Each stride changes the
// distance of the fox's nearest part, and therefore its blur and its level.
TEST_F(NoPopping, ofTheFoxInAWalkCycle) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    fox(path);
    options_.size.width = 96;
    options_.size.height = 72;
    options_.lens.fStop = 0.4;
    options_.focus = FocusDistance{125};
    PoppingOptions popping;
    popping.movements = {Movement::clip};
    popping.clip = 1;  // the clip "Walk", which takes 0.708 s
    popping.frames = 17;
    popping.pathFrames = 17;
    expectNone(popping, 128);
}

}  // namespace
}  // namespace defocus::engine
