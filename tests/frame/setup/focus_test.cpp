#include "frame/setup/focus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "lens/circle_of_confusion.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// From three points, focusThrough() finds the plane w + tan(swing)·X + tan(tilt)·Y = s that contains them: its swing,
// its tilt and the focus distance s. (X, Y) is the view-space position and w the depth.
TEST(FocusThrough, findsThePlaneOfThreePoints) {
    std::mt19937 generator(1);
    const auto random = [&](double min, double max) {
        return std::uniform_real_distribution<double>(min, max)(generator);
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
        {{{0, 0, -1}, {1, 0, -2}, {2, 0, -3}}},    // three points on a line
        {{{0, 0, -1}, {0, 1, -2}, {0, 2, -1}}},    // three points in a plane that contains the view axis
        {{{0, 0, 1}, {1, 0, 1.5}, {0, 1, 1.25}}},  // three points behind the camera
    }};
    for (const std::array<glm::dvec3, 3>& points : impossible) {
        Lens lens;
        EXPECT_THROW(focusThrough(points, lens, "test"), Error);
        EXPECT_EQ(lens.focusDistance, before.focusDistance);
        EXPECT_EQ(lens.focusTilt, before.focusTilt);
        EXPECT_EQ(lens.focusSwing, before.focusSwing);
    }
}

// From four or more points on a curved and tilted focus surface, focusThrough() finds the surface. Its depth at the
// image position n is s/(1 + κ·|n|² + t·n), with the focus distance s, the curvature κ and the tilts t of the lens.
TEST(FocusThrough, findsTheCurvedSurfaceOfManyPoints) {
    std::mt19937 generator(2);
    const auto random = [&](double min, double max) {
        return std::uniform_real_distribution<double>(min, max)(generator);
    };
    for (int i = 0; i < 100; ++i) {
        Lens expected;
        expected.focusDistance = std::exp(random(-2, 3));
        expected.focusSwing = random(-0.6, 0.6);
        expected.focusTilt = random(-0.6, 0.6);
        expected.fieldCurvature = random(-0.5, 1);
        const double tanX = tanHalfHorizontalFov(expected);
        std::vector<glm::dvec3> points;
        const int count = 4 + i % 13;
        while (points.size() < static_cast<std::size_t>(count)) {
            const glm::dvec2 field(random(-1, 1), random(-0.75, 0.75));
            const double focus =
                1 + expected.fieldCurvature * glm::dot(field, field) +
                tanX * (std::tan(expected.focusSwing) * field.x + std::tan(expected.focusTilt) * field.y);
            ASSERT_GT(focus, 0);
            const double depth = expected.focusDistance / focus;
            points.emplace_back(depth * tanX * field.x, depth * tanX * field.y, -depth);
        }
        Lens lens;
        focusThrough(points, lens, "test");
        // Four points that lie almost on a circle in the image determine the focus surface less accurately than more
        // points.
        const double tolerance = count == 4 ? 1e-5 : 1e-7;
        EXPECT_NEAR(lens.focusDistance / expected.focusDistance, 1, tolerance);
        EXPECT_NEAR(lens.focusSwing, expected.focusSwing, tolerance);
        EXPECT_NEAR(lens.focusTilt, expected.focusTilt, tolerance);
        EXPECT_NEAR(lens.fieldCurvature, expected.fieldCurvature, tolerance);
        EXPECT_NEAR(circleOfConfusion(clipCircleOfConfusion(lens, 1000, 750), -points[0].z, 1000,
                                      glm::dvec2(points[0]) / (-points[0].z * tanX) * glm::dvec2(1, 4.0 / 3)),
                    0, 1e-3);
    }
}

// If no focus surface contains all points, focusThrough() minimizes the sum of their squared blurs.
TEST(FocusThrough, leavesTheMinBlur) {
    const std::vector<glm::dvec3> points = {{-0.6, 0.2, -2}, {0.5, 0.4, -3},   {0.1, -0.3, -1.5}, {0.9, -0.4, -2.5},
                                            {-0.2, 0.5, -4}, {-0.8, -0.5, -3}, {0.3, 0.1, -2.2}};
    Lens fitted;
    focusThrough(points, fitted, "test");
    const double tanX = tanHalfHorizontalFov(fitted);
    const auto blurOf = [&](const Lens& lens) {
        const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1000, 1000);
        double sum = 0;
        for (const glm::dvec3& point : points)
            sum += std::pow(circleOfConfusion(coc, -point.z, 1000, glm::dvec2(point) / (-point.z * tanX)), 2);
        return sum;
    };
    const double min = blurOf(fitted);
    EXPECT_GT(min, 1);
    for (const double step : {-1e-3, 1e-3})
        for (double Lens::*const member :
             {&Lens::focusDistance, &Lens::focusSwing, &Lens::focusTilt, &Lens::fieldCurvature}) {
            Lens other = fitted;
            other.*member += step;
            EXPECT_GT(blurOf(other), min);
        }
}

// Points on the vertical centre line of the view do not determine the swing (tilt about the vertical axis), so
// focusThrough() chooses 0.
TEST(FocusThrough, takesTheLeastTiltWhereThePointsLeaveItOpen) {
    const std::vector<glm::dvec3> points = {{0, -0.5, -2}, {0, 0, -2.2}, {0, 0.6, -2.5}, {0, 0.9, -3}};
    Lens lens;
    focusThrough(points, lens, "test");
    EXPECT_NEAR(lens.focusSwing, 0, 1e-9);
    EXPECT_LT(lens.focusTilt, -0.01) << "the top of the plane is farther away";
}

// The default focus is the surface in the middle of the image: the front of a box, not its centre. If the middle of the
// image is empty, the scene's centre is in focus.
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

    small.view.worldFromCamera = glm::translate(glm::dmat4(1), glm::dvec3(100, 0, 0));  // the view misses all objects
    chooseFocus({}, {}, small.scene, small.world.pose, small.view);
    EXPECT_NEAR(small.view.lens.focusDistance, 6, 1e-6);
}

}  // namespace
}  // namespace defocus::engine
