#include "frame/focus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "small_world.h"

namespace defocus {
namespace {

// Points on the plane w + tan(swing)·X + tan(tilt)·Y = s give back what it was made of.
TEST(FocusThrough, findsThePlaneOfThreePoints) {
    std::mt19937 generator(1);
    const auto random = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(generator);
    };
    for (int i = 0; i < 100; ++i) {
        const double swing = random(-0.8, 0.8);
        const double tilt = random(-0.8, 0.8);
        const double distance = std::exp(random(-4, 4));
        std::array<glm::dvec3, 3> points;
        for (int p = 0; p < 3; ++p) {
            const double angle = 2.1 * p + random(0, 1);
            const double x = distance * std::cos(angle);
            const double y = distance * std::sin(angle);
            points[static_cast<std::size_t>(p)] = {x, y, -(distance - std::tan(swing) * x - std::tan(tilt) * y)};
        }
        Lens lens;
        focusThrough(points, lens, "test");
        EXPECT_NEAR(lens.focusDistance, distance, 1e-9 * distance);
        EXPECT_NEAR(lens.focusSwing, swing, 1e-9);
        EXPECT_NEAR(lens.focusTilt, tilt, 1e-9);
    }
}

TEST(FocusThrough, leavesTheLensAloneWhereThereIsNoSuchPlane) {
    const Lens before;
    const std::array<std::array<glm::dvec3, 3>, 3> impossible = {{
        {{{0, 0, -1}, {1, 0, -2}, {2, 0, -3}}},    // a line
        {{{0, 0, -1}, {0, 1, -2}, {0, 2, -1}}},    // holds the view axis
        {{{0, 0, 1}, {1, 0, 1.5}, {0, 1, 1.25}}},  // behind the camera
    }};
    for (const std::array<glm::dvec3, 3>& points : impossible) {
        Lens lens;
        EXPECT_THROW(focusThrough(points, lens, "test"), Error);
        EXPECT_EQ(lens.focusDistance, before.focusDistance);
        EXPECT_EQ(lens.focusTilt, before.focusTilt);
        EXPECT_EQ(lens.focusSwing, before.focusSwing);
    }
}

// A box is sharp at its front, not in its middle, which nobody sees. Where the image's middle shows nothing, the scene's centre
// counts.
TEST(ChooseFocus, isWhatTheMiddleShowsWhereNobodySaysMore) {
    SmallWorld small;
    small.scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small.scene.meshes.push_back(quad(0));
    place(small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4)));
    place(small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -8)));
    finish(small);
    small.world.pose.bounds = {{-1, -1, -8}, {1, 1, -4}};
    small.view.width = 64;
    small.view.height = 48;
    chooseFocus({}, {}, small.scene, small.world.pose, small.view);
    EXPECT_NEAR(small.view.lens.focusDistance, 4, 1e-6);

    Camera own;
    own.lens["focusDistance"] = 7;
    chooseFocus({}, own, small.scene, small.world.pose, small.view);
    EXPECT_EQ(small.view.lens.focusDistance, 7);

    small.view.worldFromCamera = glm::translate(glm::dmat4(1), glm::dvec3(100, 0, 0));  // beside all
    chooseFocus({}, {}, small.scene, small.world.pose, small.view);
    EXPECT_NEAR(small.view.lens.focusDistance, 6, 1e-6);
}

}  // namespace
}  // namespace defocus
