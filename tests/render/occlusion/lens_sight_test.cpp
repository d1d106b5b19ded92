#include "render/occlusion/lens_sight.h"

#include <gtest/gtest.h>

#include <random>

#include "plan/frame_plan.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

struct PlaceInImage {
    glm::dvec2 place;  // position in px from the lower left corner
    double depth;      // depth along the view axis, m
};

// Returns the image position of the view-space point `inView` for a lens sample, by geometric optics. The ray from the
// lens point through `inView` meets the focal plane at a point. The result is the position of this point in a pinhole
// image, less the sample's offset in the pixel.
PlaceInImage seenThroughLens(const glm::dvec3& inView, const LensSample& sample, const FramePlan& plan) {
    const View& view = plan.view;
    const double radius = view.lens.dofEnabled ? 0.5e-3 * view.lens.focalLength / view.lens.fStop : 0;
    const glm::dvec3 eye = radius * glm::dvec3(sample.lens, 0);
    const double focus = view.lens.focusDistance;
    const glm::dvec3 inFocus = eye + (inView - eye) * (focus / -inView.z);
    const glm::dvec2 ndc = glm::dvec2(inFocus) / (focus * plan.tanHalfHorizontal) *
                           glm::dvec2(1, static_cast<double>(view.width) / view.height);
    return {0.5 * (ndc + 1.0) * glm::dvec2(view.width, view.height) - glm::dvec2(sample.pixel), -inView.z};
}

// Draws random points in random object-space boxes. For each sample, expects a point's image to lie inside the bounds
// computed for its box.
void expectBoxesHoldWhatIsSeen(const SmallWorld& small) {
    const RenderSettings settings{.sampleCount = 32};
    const FramePlan plan = planFrame(small.world, small.view, settings);
    ASSERT_TRUE(seesBoxes(plan));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> side(-1, 1);
    const auto any = [&] { return glm::vec3(side(random), side(random), side(random)); };
    int inside = 0;
    for (const ObjectPlan& object : plan.objects)
        for (std::uint32_t s = 0; s < plan.samples.size(); ++s) {
            ASSERT_TRUE(seesBoxes(object));
            const LensSight sight(plan, object, s);
            for (int i = 0; i < 50; ++i) {
                const glm::vec3 centre = any();
                const glm::vec3 reach = 0.1f * glm::abs(any());
                const std::optional<SeenBox> seen = sight.of(centre, reach);
                ASSERT_TRUE(seen);
                for (int k = 0; k < 8; ++k) {
                    const glm::dvec3 place(centre + reach * any());
                    const PlaceInImage pixel = seenThroughLens(glm::dvec3(object.viewFromObject * glm::dvec4(place, 1)),
                                                               plan.samples[s], plan);
                    ASSERT_GE(seen->depth, plan.view.nearPlane / pixel.depth);
                    const glm::dvec2 at = pixel.place;
                    if (at.x < 0 || at.y < 0 || at.x > plan.view.width || at.y > plan.view.height) continue;
                    ++inside;
                    ASSERT_TRUE(at.x >= seen->left && at.x <= seen->right && at.y >= seen->bottom && at.y <= seen->top);
                }
            }
        }
    EXPECT_GT(inside, 10'000);
}

TEST(LensSight, boxesHoldWhatTheLensSees) {
    expectBoxesHoldWhatIsSeen(*fiveSpheres());
}

// The image bounds of boxes also hold for a pinhole camera, whose plan has no lens.
TEST(LensSight, boxesHoldWhatAPinholeSees) {
    const auto small = fiveSpheres();
    small->view.lens.dofEnabled = false;
    expectBoxesHoldWhatIsSeen(*small);
}

// The image bounds of a small box are at most 3 px wide, and their depth is the depth of the box.
TEST(LensSight, boxesAreNotMuchLargerThanWhatTheyHold) {
    const auto small = fiveSpheres();
    const RenderSettings settings{.sampleCount = 8};
    const FramePlan plan = planFrame(small->world, small->view, settings);
    const ObjectPlan& object = plan.objects.front();
    const LensSight sight(plan, object, 3);
    const std::optional<SeenBox> seen = sight.of({0, 0, 0}, {1e-4f, 1e-4f, 1e-4f});
    ASSERT_TRUE(seen);
    EXPECT_LE(seen->right - seen->left, 3);
    EXPECT_LE(seen->top - seen->bottom, 3);
    const double distance = -object.viewFromObject[3].z;
    EXPECT_NEAR(seen->depth, plan.view.nearPlane / distance, 1e-3 * plan.view.nearPlane / distance);
    EXPECT_FALSE(sight.of({0, 0, 0}, {100, 100, 100}));  // the camera lies inside the box
}

// Image bounds of boxes are available only if the circle of confusion is a linear function of depth. Lens controls,
// motion or an object's blur scale make it nonlinear.
TEST(LensSight, knowsWhereItDoesNotHold) {
    const RenderSettings settings{.sampleCount = 8};
    const auto plan = [&](const auto& change) {
        const auto small = fiveSpheres();
        change(*small);
        return planFrame(small->world, small->view, settings);
    };
    EXPECT_TRUE(seesBoxes(plan([](SmallWorld&) {})));
    EXPECT_FALSE(seesBoxes(plan([](SmallWorld& small) { small.view.lens.fieldCurvature = 0.3; })));
    EXPECT_FALSE(seesBoxes(plan([](SmallWorld& small) { small.view.lens.foregroundLimit = 3; })));
    EXPECT_FALSE(seesBoxes(plan([](SmallWorld& small) { small.view.lens.axialChromaticAberration = 0.5; })));
    const FramePlan moving = plan([](SmallWorld& small) {
        small.world.shutter.poses.assign(2, small.world.pose);
        for (Object& object : small.world.shutter.poses[1].objects) object.worldFromObject[3].x += 0.1;
    });
    EXPECT_FALSE(seesBoxes(moving));
}

}  // namespace
}  // namespace defocus::engine
