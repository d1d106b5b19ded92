// Tests depth of field against textbook formulas and tables, and against the renderer's blur.
#include "lens/depth_of_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lens/circle_of_confusion.h"

namespace defocus::engine {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

Lens lensOf(double focalLength, double fStop, double focusDistance, bool breathing) {
    return {.focalLength = focalLength, .fStop = fStop, .focusDistance = focusDistance, .focusBreathing = breathing};
}

// Returns the diameter of the blur disk on the sensor, mm, by Newton's and Gauss's equations, independent of the code
// under test. With the focal length f, a point at depth z is imaged at i(z) = f·z/(z − f) behind the lens. For the
// focus distance s, the sensor lies at i(s). The cone from the aperture of diameter f/N meets the sensor in a disk of
// diameter f/N·|i(s) − i(z)|/i(z).
double diskOfTheThinLens(const Lens& lens, double z) {
    const double f = lens.focalLength;  // mm
    const auto image = [&](double depth) { return 1000 * depth * f / (1000 * depth - f); };
    const double sensor = image(lens.focusDistance);
    const double at = std::isinf(z) ? f : image(z);
    return f / lens.fStop * std::abs(sensor - at) / at;
}

TEST(DepthOfField, limitsOfATextbookLens) {
    // A 50 mm lens at f/8 with an acceptable circle of confusion of 0.03 mm has the hyperfocal distance H = 2500/0.24 +
    // 50 = 10466.67 mm.
    const Lens lens = lensOf(50, 8, 3, true);
    const DepthOfField depth = depthOfField(lens, 0.03);
    EXPECT_NEAR(depth.hyperfocal, 10.4666667, 1e-6);
    EXPECT_NEAR(depth.near, 3000.0 * (10466.6667 - 50) / (10466.6667 + 3000 - 100) / 1000, 1e-6);
    EXPECT_NEAR(depth.far, 3000.0 * (10466.6667 - 50) / (10466.6667 - 3000) / 1000, 1e-6);
}

TEST(DepthOfField, diskAtTheLimitsOfTheThinLensIsTheAcceptableOne) {
    for (const double f : {24.0, 50.0, 200.0})
        for (const double s : {0.7, 3.0, 12.0}) {
            const Lens lens = lensOf(f, 4, s, true);
            const DepthOfField depth = depthOfField(lens, 0.025);
            EXPECT_NEAR(diskOfTheThinLens(lens, depth.near), 0.025, 1e-9) << f << " mm, " << s << " m";
            if (std::isfinite(depth.far)) {
                EXPECT_NEAR(diskOfTheThinLens(lens, depth.far), 0.025, 1e-9);
            }
            EXPECT_EQ(std::isinf(depth.far), diskOfTheThinLens(lens, unlimited) <= 0.025);
        }
}

// At both limits of the depth of field, the blur of rendered images equals the acceptable circle of confusion, for any
// image width and blur scale.
TEST(DepthOfField, blurOfTheImageAtTheLimitsIsTheAcceptableOne) {
    for (const bool breathing : {false, true})
        for (const int width : {640, 300}) {
            Lens lens = lensOf(85, 1.8, 2.2, breathing);
            lens.horizontalAperture = 23.6;
            lens.blurScale = 1.5;
            const double acceptable = 0.02;
            const DepthOfField depth = depthOfField(lens, acceptable);
            const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, width, 400);
            const double pixels = acceptable / lens.horizontalAperture * width;
            EXPECT_NEAR(circleOfConfusion(coc, depth.near, width), -pixels, 1e-9);
            EXPECT_NEAR(circleOfConfusion(coc, depth.far, width), pixels, 1e-9);
        }
}

TEST(DepthOfField, focusedAtTheHyperfocalDistanceItReachesFromHalfOfItToInfinity) {
    for (const bool breathing : {false, true}) {
        Lens lens = lensOf(35, 5.6, 3, breathing);
        lens.focusDistance = depthOfField(lens, 0.03).hyperfocal;
        const DepthOfField depth = depthOfField(lens, 0.03);
        EXPECT_TRUE(std::isinf(depth.far));
        EXPECT_NEAR(depth.near, lens.focusDistance / 2, 1e-9);
        lens.focusDistance *= 0.999;
        EXPECT_FALSE(std::isinf(depthOfField(lens, 0.03).far));
        lens.focusDistance = unlimited;
        EXPECT_TRUE(std::isinf(depthOfField(lens, 0.03).far));
        EXPECT_NEAR(depthOfField(lens, 0.03).near, depth.hyperfocal - (breathing ? 0.035 : 0), 1e-9);
    }
}

TEST(DepthOfField, ofAPinholeIsEverything) {
    const Lens lens{.dofEnabled = false};
    const DepthOfField depth = depthOfField(lens, 0.03);
    EXPECT_EQ(depth.near, 0);
    EXPECT_TRUE(std::isinf(depth.far));
    EXPECT_EQ(depth.hyperfocal, 0);
}

TEST(DepthOfField, customaryCircleIsTheDiagonalOver1500) {
    EXPECT_NEAR(customaryCircleOfConfusion(Lens{}, 1500, 1000), std::hypot(36, 24) / 1500, 1e-12);
    EXPECT_NEAR(customaryCircleOfConfusion(Lens{}, 400, 300), 0.03, 1e-12);
}

}  // namespace
}  // namespace defocus::engine
