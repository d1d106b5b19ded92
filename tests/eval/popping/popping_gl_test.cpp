#include <gtest/gtest.h>

#include "eval/popping/popping.h"
#include "gl_context_test.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Popping : public GlContextTest {
protected:
    Popping() : small_(fiveCoarseSpheres()) {
        for (const Object& object : small_->world.pose.objects)
            small_->world.pose.bounds.extend(glm::dvec3(object.worldFromObject[3]));
        options_.movements = {Movement::focusPull};
        options_.sampleCounts = {8};
        options_.frames = 6;
        options_.pathFrames = 40;
    }

    void measure() {
        PoppingVisitor visitor;
        visitor.frames = [&](std::span<const PoppingFrame> added) {
            frames_.insert(frames_.end(), added.begin(), added.end());
        };
        visitor.firstFrames = [&](std::span<const PoppingFrame> first) {
            EXPECT_TRUE(first_.empty() && frames_.empty());
            first_.assign(first.begin(), first.end());
        };
        visitor.sampleStep = [&](const SampleStep& step) { steps_.push_back(step); };
        measurePopping(small_->world, small_->view, options_, visitor);
    }

    std::unique_ptr<SmallWorld> small_;
    PoppingOptions options_;
    std::vector<PoppingFrame> first_, frames_;
    std::vector<SampleStep> steps_;
};

// With pyramids of one level, every mode draws full detail, so the modes do not differ.
TEST_F(Popping, withoutCoarserLevelsThereIsNone) {
    changePyramids(small_->world, [&](Pyramid& pyramid) { pyramid = fullDetail(small_->scene.meshes[0]); });
    options_.movements = {Movement::focusPull, Movement::dolly, Movement::turntable};
    options_.frames = 3;
    measure();
    ASSERT_EQ(frames_.size(), 3u * 2 * poppingModes.size());
    for (const PoppingFrame& frame : frames_) {
        EXPECT_LT(frame.change.image.rmse, 1e-7);  // tolerance for rounding of sums in single precision
        EXPECT_EQ(frame.step.image.rmse, 0);
        // tolerance for rounding in the conversion to display values and back
        EXPECT_LT(frame.change.image.flip, 1e-6);
        EXPECT_EQ(frame.speed, 0);
    }
    EXPECT_TRUE(steps_.empty());
}

TEST_F(Popping, isMeasuredForEachModeAtEachChange) {
    options_.sampleCounts = {4, 8};
    measure();
    ASSERT_EQ(frames_.size(), 2u * 5 * poppingModes.size());
    double fastest = 0;
    double worst = 0;
    for (const PoppingFrame& frame : frames_) {
        EXPECT_GE(frame.frame, 1);
        EXPECT_LE(frame.frame, 5);
        EXPECT_GE(frame.change.objects.rmse, frame.change.image.rmse) << "differences lie in the objects' pixels";
        EXPECT_GE(frame.step.objects.rmse, frame.step.image.rmse);
        fastest = std::max(fastest, frame.speed);
        worst = std::max(worst, frame.step.image.rmse);
    }
    EXPECT_GT(fastest, 0);
    EXPECT_GT(worst, 0);
}

TEST_F(Popping, firstResultIsAQuarterOfTheFirstMovement) {
    options_.movements = {Movement::turntable, Movement::dolly};
    options_.frames = 12;
    measure();
    ASSERT_EQ(first_.size(), 2u * poppingModes.size()) << "changes between three frames";
    for (std::size_t i = 0; i < first_.size(); ++i) {
        EXPECT_EQ(first_[i].movement, Movement::turntable);
        EXPECT_EQ(first_[i].frame, frames_[i].frame);
        EXPECT_EQ(first_[i].step.objects.rmse, frames_[i].step.objects.rmse);
    }
}

// A pop is the image change if all N lens samples switch to another level at once. If one sample switches, the image
// changes by a fraction of the pop. By the triangle inequality, this fraction is at least 1/N on average. In the worst
// case, the changes of the N samples are independent of each other. The pop is then about √N times the change of one
// sample, so the fraction is at most about 1/√N.
TEST_F(Popping, oneSamplesStepIsASmallPartOfALevels) {
    options_.sampleCounts = {4, 16};
    options_.frames = 2;
    measure();
    ASSERT_EQ(steps_.size(), 2u);
    for (const SampleStep& step : steps_) {
        EXPECT_GE(step.measured, 1.0 / step.samples);
        EXPECT_LE(step.measured, 1.2 / std::sqrt(step.samples));
        EXPECT_GT(step.coc, 2);
    }
    EXPECT_LT(steps_[1].measured, 0.5 * steps_[0].measured);
}

}  // namespace
}  // namespace defocus::engine
