#include "plan/lens_cells/automatic_cells.h"

#include <gtest/gtest.h>

#include "plan/frame_plan.h"

namespace defocus::engine {
namespace {

// Returns a plan for an image of 1000 × 750 px with a field of view of 90°. The thin lens has an aperture of 0.1 m and
// is focused at 2 m, so the blur at depth z is c = 50·|1/2 − 1/z| px.
FramePlan planOfLens() {
    FramePlan plan;
    plan.view.width = 1000;
    plan.view.height = 750;
    plan.view.nearPlane = 0.01;
    plan.tanHalfHorizontal = 1;
    plan.coc = {.a = -0.05, .aBehind = -0.05, .front = 0.025, .behind = 0.025, .aspect = 4.0 / 3};
    plan.frameSamples = 64;
    plan.largestBlur = 25;
    return plan;
}

// Adds a box with the given view-space corners to the plan. Boxes must be added from front to back.
void addBox(FramePlan& plan, const glm::dvec3& minimum, const glm::dvec3& maximum) {
    ObjectPlan object;
    object.viewBox = Bounds{minimum, maximum};
    object.nearestDepth = -maximum.z;
    object.farthestDepth = -minimum.z;
    plan.objects.push_back(object);
}

// A wall at 10 m, where the blur has a diameter of 20 px, fills the left half of the image.
TEST(BlurredShare, isTheAreaOfWhatIsBlurred) {
    FramePlan plan = planOfLens();
    addBox(plan, {-20, -20, -10.01}, {0, 20, -10});
    EXPECT_NEAR(blurredShare(plan, 19), 0.5, 0.01);
    EXPECT_EQ(blurredShare(plan, 21), 0);
}

// A wall in focus hides the blurred wall behind it.
TEST(BlurredShare, leavesOutWhatIsHidden) {
    FramePlan plan = planOfLens();
    addBox(plan, {-3, -3, -2.01}, {3, 3, -2});
    addBox(plan, {-20, -20, -10.01}, {20, 20, -10});
    EXPECT_EQ(blurredShare(plan, 8), 0);
}

// The background counts as blurred only if it is an environment map, since other backgrounds have no detail to blur.
TEST(BlurredShare, countsTheBackgroundOnlyIfItIsAMap) {
    FramePlan plan = planOfLens();
    EXPECT_EQ(blurredShare(plan, 8), 0);
    plan.showsMap = true;
    EXPECT_EQ(blurredShare(plan, 8), 1);
}

TEST(AutomaticMethod, accumulatesWhereLensCellsDontServe) {
    FramePlan plan = planOfLens();
    addBox(plan, {-20, -20, -10.01}, {20, 20, -10});
    EXPECT_EQ(reasonForAccumulation(plan), "");
    FramePlan transparent = plan;
    transparent.needsAlpha = true;
    EXPECT_NE(reasonForAccumulation(transparent).find("transparent"), std::string::npos);
    FramePlan tile = plan;
    tile.tile = Tile{};
    EXPECT_NE(reasonForAccumulation(tile).find("tiles"), std::string::npos);
    FramePlan sharp = planOfLens();
    addBox(sharp, {-20, -20, -2.1}, {20, 20, -2});
    EXPECT_NE(reasonForAccumulation(sharp).find("blurred"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
