#include "render/post_process/transparency_buckets.h"

#include <gtest/gtest.h>

#include <limits>

namespace defocus::engine {
namespace {

// An object of a test plan and its blur in px. Plans list objects from front to back.
struct Flat {
    double blur = 0;
    bool blended = true;
    bool transmits = false;
};

FramePlan planOf(const std::vector<Flat>& objects) {
    FramePlan plan;
    plan.view.width = 100;
    plan.view.height = 100;
    plan.view.nearPlane = 0.1;
    plan.tanHalfHorizontal = 1;
    plan.usesBlending = true;
    for (const Flat& flat : objects) {
        ObjectPlan& object = plan.objects.emplace_back();
        object.coc.nearest = flat.blur - 3;
        object.coc.farthest = flat.blur + 3;
        object.blended = flat.blended;
        object.transmits = flat.transmits;
        object.nearestDepth = 1 + static_cast<double>(plan.objects.size());
        object.viewBox.extend(glm::dvec3(-1, -1, -object.nearestDepth));
        object.viewBox.extend(glm::dvec3(1, 1, -object.nearestDepth));
    }
    return plan;
}

void moveRight(ObjectPlan& object) {
    object.viewBox.minimum.x += 4;
    object.viewBox.maximum.x += 4;
}

using Buckets = std::vector<TransparencyBucket>;

TEST(TransparencyBuckets, partAtTheLargestStepsOfBlur) {
    const FramePlan plan = planOf({{-40}, {-38}, {-20}, {-12}, {9}});
    EXPECT_EQ(transparencyBuckets(plan, 1), (Buckets{{0, 1, 2, 3, 4}}));
    EXPECT_EQ(transparencyBuckets(plan, 2), (Buckets{{4}, {0, 1, 2, 3}}));
    EXPECT_EQ(transparencyBuckets(plan, 3), (Buckets{{4}, {2, 3}, {0, 1}}));
    EXPECT_EQ(transparencyBuckets(plan, 4), (Buckets{{4}, {3}, {2}, {0, 1}}));
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{4}, {3}, {2}, {1}, {0}}));
}

TEST(TransparencyBuckets, holdWhatIsBlurredAlikeTogether) {
    EXPECT_EQ(transparencyBuckets(planOf({{5}, {5.4}, {5.9}, {8}}), 8), (Buckets{{3}, {0, 1, 2}}));
}

TEST(TransparencyBuckets, passOverOpaqueObjects) {
    const FramePlan plan = planOf({{-9, false}, {-5}, {0, false}, {5}, {9, false}});
    EXPECT_EQ(transparencyBuckets(plan, 1), (Buckets{{1, 3}}));
    EXPECT_EQ(transparencyBuckets(plan, 2), (Buckets{{3}, {1}}));
}

TEST(TransparencyBuckets, leaveOutWhatMayBeSeenThroughAnother) {
    FramePlan plan = planOf({{-9}, {0, false, true}, {5}, {9}});
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{0}}));
    moveRight(plan.objects[2]);  // object 2 is now beside the transmitting object
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{2}, {0}}));
    plan.objects[2].transmits = true;
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{0}}));
}

// Blended surfaces are blurred in groups (buckets), which are drawn last. If a blended object is in no bucket, an
// object behind it must not be in a bucket either, since it would be drawn over that blended object.
TEST(TransparencyBuckets, keepTheOrderOfWhatTheyLeaveOut) {
    FramePlan plan = planOf({{0, false, true}, {3}, {6}});
    moveRight(plan.objects[2]);
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{2}}));
    plan.objects[1].viewBox.maximum.x = 9;
    EXPECT_EQ(transparencyBuckets(plan, 8), Buckets{});
}

TEST(TransparencyBuckets, areNoneWithoutNeed) {
    FramePlan plan = planOf({{-9}, {9}});
    EXPECT_EQ(transparencyBuckets(plan, 0), Buckets{});
    plan.usesLens = false;
    EXPECT_EQ(transparencyBuckets(plan, 8), Buckets{});
    EXPECT_EQ(transparencyBuckets(planOf({{-9, false}, {9, false}}), 8), Buckets{});
    EXPECT_EQ(transparencyBuckets(planOf({}), 8), Buckets{});
}

TEST(TransparencyBuckets, reachAsFarAsTheirBlur) {
    FramePlan plan = planOf({{0}, {40}});
    plan.view.width = 1000;
    plan.view.height = 500;
    for (ObjectPlan& object : plan.objects) {
        object.coc.nearest = object.coc.farthest = 20;
        object.coc.largest = 20;
    }
    // At a depth of 2 m, the object's extent of [−1, 1] m is the middle half of the image's width, which is [−2, 2] m,
    // and the full height of the image. The margin is 24 px.
    const TexelRectangle reach = reachOf({0}, plan);
    EXPECT_EQ(reach.x, 250 - 10 - 24);
    EXPECT_EQ(reach.width, 500 + 2 * (10 + 24));
    EXPECT_EQ(reach.y, 0);
    EXPECT_EQ(reach.height, 500);
    // In front of the focal plane, a method may gather with the largest blur of all objects, here 60 px.
    plan.objects[1].coc.nearest = -60;
    EXPECT_EQ(reachOf({0}, plan).x, 250 - 30 - 24);
    moveRight(plan.objects[0]);
    moveRight(plan.objects[0]);
    EXPECT_EQ(reachOf({0}, plan).width, 0);
    // the object reaches the near plane, so it may be visible anywhere in the image
    plan.objects[0].nearestDepth = plan.view.nearPlane;
    EXPECT_EQ(reachOf({0}, plan).width, 1000);
}

// An object that reaches the camera has an infinite blur, so it is blurred separately (in a bucket without other
// objects).
TEST(TransparencyBuckets, partWhatReachesTheCamera) {
    FramePlan plan = planOf({{-9}, {9}});
    plan.objects[0].coc.nearest = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(transparencyBuckets(plan, 8), (Buckets{{1}, {0}}));
}

}  // namespace
}  // namespace defocus::engine
