// Tests motion during the exposure: the times of samples, bounds over the exposure, and errors for invalid shutters.

#include "plan/motion/motion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "plan/plan_checks.h"
#include "plan/plan_text.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Sets `moments` poses, evenly spaced over the exposure. The first sphere moves by `step` from each pose to the next.
void moveFirst(SmallWorld& small, std::size_t moments, const glm::dvec3& step) {
    small.world.shutter.poses.assign(moments, small.world.pose);
    for (std::size_t i = 0; i < moments; ++i) {
        glm::dmat4& matrix = small.world.shutter.poses[i].objects[0].worldFromObject;
        matrix = glm::translate(glm::dmat4(1), static_cast<double>(i) * step) * matrix;
    }
}

TEST(Motion, whatStandsStillHasNoMotionPath) {
    const auto small = fiveSpheres();
    const std::string still = planTable(planFrame(small->world, small->view, settingsFor(8)));
    moveFirst(*small, 3, glm::dvec3(0));
    small->view.shutterCameras.assign(3, small->view.worldFromCamera);
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(8));
    EXPECT_TRUE(plan.moments.empty());
    EXPECT_TRUE(plan.middleFromView.empty());
    EXPECT_TRUE(leftOut(plan, "motion path"));
    EXPECT_EQ(planTable(plan), still);
}

TEST(Motion, onlyWhatMovesGetsPoses) {
    const auto small = fiveSpheres();
    moveFirst(*small, 2, {0.1, 0, 0});
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(8));
    EXPECT_FALSE(leftOut(plan, "motion path"));
    EXPECT_EQ(plan.moments.size(), plan.samples.size());
    for (const ObjectPlan& object : plan.objects) EXPECT_EQ(object.motion.size(), object.object == 0 ? 2u : 0u);
    EXPECT_TRUE(plan.middleFromView.empty());  // the camera does not move
    EXPECT_NE(planTable(plan).find("moves"), std::string::npos);
}

TEST(Motion, aMovingCameraMovesEverything) {
    const auto small = fiveSpheres();
    small->view.shutterCameras.assign(2, small->view.worldFromCamera);
    small->view.shutterCameras[1] = glm::translate(small->view.worldFromCamera, glm::dvec3(0, 0, 0.25));
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(8));
    for (const ObjectPlan& object : plan.objects) EXPECT_EQ(object.motion.size(), 2u);
    ASSERT_EQ(plan.middleFromView.size(), 2u);
    EXPECT_DOUBLE_EQ(plan.middleFromView[1][3].z, 0.25);
}

TEST(Motion, samplesFindTheirMoments) {
    const auto small = fiveSpheres();
    for (const std::size_t moments : {2u, 5u, 65u}) {
        moveFirst(*small, moments, {0.01, 0, 0});
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(200));
        EXPECT_EQ(plan.samples[0].time, 0.5f);
        for (std::size_t i = 0; i < plan.samples.size(); ++i) {
            const SampleMoment& at = plan.moments[i];
            ASSERT_LT(at.moment + (at.fraction > 0 ? 1 : 0), moments);
            ASSERT_GE(at.fraction, 0);
            const double time = (at.moment + static_cast<double>(at.fraction)) / static_cast<double>(moments - 1);
            ASSERT_NEAR(time, static_cast<double>(plan.samples[i].time), 1e-6);
        }
    }
    moveFirst(*small, 200, {0.001, 0, 0});
    small->world.shutter.perSample = true;
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(200));
    for (std::uint32_t i = 0; i < 200; ++i) {
        EXPECT_EQ(plan.moments[i].moment, i);
        EXPECT_EQ(plan.moments[i].fraction, 0);
    }
}

TEST(Motion, boundsBlurAndCullingCoverTheWholeExposure) {
    const auto small = fiveSpheres();
    // All objects except one are far away. This one crosses the frame and is outside it at both ends of the exposure.
    for (Object& object : small->world.pose.objects) object.worldFromObject[3] += glm::dvec4(0, 0, -40, 0);
    Object& crossing = small->world.pose.objects[0];
    crossing.worldFromObject = glm::translate(glm::dmat4(1), glm::dvec3(30, 0, -3));
    small->world.shutter.poses.assign(2, small->world.pose);
    small->world.shutter.poses[0].objects[0].worldFromObject = glm::translate(glm::dmat4(1), glm::dvec3(-30, 0, -8));
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(8));
    const auto found = std::find_if(plan.objects.begin(), plan.objects.end(),
                                    [](const ObjectPlan& object) { return object.object == 0; });
    ASSERT_NE(found, plan.objects.end());
    EXPECT_NEAR(found->nearestDepth, 2, 0.05);
    EXPECT_NEAR(found->farthestDepth, 9, 0.05);
    EXPECT_EQ(found->coc.smallest, 0);  // the object crosses the focus plane at 3 m
    small->world.shutter = {};
    EXPECT_TRUE(leftOut(planFrame(small->world, small->view, settingsFor(8)), "object Object 0"));
}

// A moving scene is drawn with all requested samples even if nothing is out of focus.
TEST(Motion, samplesRemainForMotionWithoutALens) {
    const auto small = fiveSpheres();
    small->view.lens.dofEnabled = false;
    EXPECT_EQ(planFrame(small->world, small->view, settingsFor(64)).samples.size(), antialiasingSamples);
    moveFirst(*small, 2, {0.1, 0, 0});
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    EXPECT_EQ(plan.samples.size(), 64u);
    EXPECT_FALSE(plan.usesLens);
}

TEST(Motion, shuttersThatDoNotFitAreRefused) {
    const auto small = fiveSpheres();
    moveFirst(*small, 3, {0.1, 0, 0});
    small->view.shutterCameras.assign(2, small->view.worldFromCamera);
    EXPECT_THROW((void)planFrame(small->world, small->view, settingsFor(4)), Error);
    small->view.shutterCameras.clear();
    small->world.shutter.perSample = true;
    EXPECT_THROW((void)planFrame(small->world, small->view, settingsFor(4)), Error);
    small->world.shutter.perSample = false;
    small->world.shutter.poses[1].objects.pop_back();
    EXPECT_THROW((void)planFrame(small->world, small->view, settingsFor(4)), Error);
    small->world.shutter.poses.resize(1);
    EXPECT_THROW((void)planFrame(small->world, small->view, settingsFor(4)), Error);
}

}  // namespace
}  // namespace defocus::engine
