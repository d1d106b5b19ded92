#include "lens/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "lens/circle_of_confusion.h"

namespace defocus::engine {
namespace {

TEST(Lens, circleOfConfusionOfATextbookExample) {
    // A 50 mm lens at f/2 has an aperture diameter A = 25 mm, and tan(θx/2) = 36/100 for its horizontal field of view
    // θx. Focused at 2 m, in an image 1000 px wide, the blur of a point at 4 m is c = 0.025·(1/2 − 1/4)·1000/0.72 =
    // 8.6806 px.
    const Lens lens{.fStop = 2, .focusDistance = 2};
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1024, 768);
    EXPECT_NEAR(circleOfConfusion(coc, 4, 1000), 0.025 * 0.25 * 1000 / 0.72, 1e-12);
    EXPECT_NEAR(circleOfConfusion(coc, 1, 1000), -0.025 * 0.5 * 1000 / 0.72, 1e-12);
    EXPECT_NEAR(circleOfConfusion(coc, 2, 1000), 0, 1e-12);
}

TEST(Lens, clipFormIsTheFormulaForEveryDepth) {
    Lens lens;
    for (const double s : {0.3, 2.5, 1e6}) {
        lens.focusDistance = s;
        const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1024, 768);
        for (const double z : {0.01, 0.5, 3.0, 1e4}) {
            const double expected = apertureDiameter(lens) * (1 / s - 1 / z) * 640 / (2 * tanHalfHorizontalFov(lens));
            EXPECT_NEAR(circleOfConfusion(coc, z, 640), expected, 1e-9 * std::abs(expected));
            EXPECT_NEAR((coc.a + coc.front * z) / z * 640, expected, 1e-9 * std::abs(expected));
        }
    }
}

TEST(Lens, focusAtInfinityBlursTheForegroundOnly) {
    const Lens lens{.focusDistance = std::numeric_limits<double>::infinity()};
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1024, 768);
    EXPECT_EQ(circleOfConfusion(coc, std::numeric_limits<double>::infinity(), 1024), 0);
    EXPECT_LT(circleOfConfusion(coc, 10, 1024), 0);
}

TEST(Lens, focusBreathingIsTheThinLens) {
    // A thin lens of focal length f, focused at s, has the image distance i = f·s/(s − f). tan(θx/2) is half the width
    // of the sensor over i. On the sensor, the CoC at depth z is A·|z − s|/z · i/s, with the aperture diameter A. The
    // image has W/horizontalAperture px per mm of the sensor, with the image width W in px.
    const Lens lens{.focusDistance = 1, .focusBreathing = true};
    const double f = 0.05;
    const double i = f * 1 / (1 - f);
    const double A = apertureDiameter(lens);
    const double onSensor = A * (3.0 - 1.0) / 3.0 * i / 1.0;
    EXPECT_NEAR(circleOfConfusion(clipCircleOfConfusion(lens, 1024, 768), 3, 1024), onSensor * 1024 / 0.036, 1e-9);
}

TEST(Lens, rangeThatStraddlesFocusHasNoSmallestBlur) {
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(Lens{}, 1024, 768);
    EXPECT_EQ(circleOfConfusionRange(coc, {1, 5}, 1024).smallest, 0);
    const CocRange behind = circleOfConfusionRange(coc, {3, 5}, 1024);
    EXPECT_DOUBLE_EQ(behind.smallest, behind.nearest);
    EXPECT_DOUBLE_EQ(behind.largest, behind.farthest);
    const CocRange front = circleOfConfusionRange(coc, {1, 2}, 1024);
    EXPECT_DOUBLE_EQ(front.smallest, -front.farthest);
    EXPECT_DOUBLE_EQ(front.largest, -front.nearest);
}

TEST(Lens, disabledDepthOfFieldIsAPinhole) {
    const Lens lens{.dofEnabled = false};
    EXPECT_EQ(apertureDiameter(lens), 0);
    EXPECT_EQ(circleOfConfusion(clipCircleOfConfusion(lens, 1024, 768), 0.1, 1024), 0);
}

TEST(Lens, fieldOfViewAndFocalLengthAreInverses) {
    const Lens lens{.focalLength = 85};
    EXPECT_NEAR(focalLengthFromFov(tanHalfHorizontalFov(lens), lens.horizontalAperture), 85, 1e-12);
}

TEST(Lens, impossibleLensesAreNamed) {
    const auto message = [](auto change) -> std::string {
        Lens lens;
        change(lens);
        try {
            checkLens(lens);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(message([](Lens& l) { l.fStop = 0; }).find("f-number"), std::string::npos);
    EXPECT_NE(message([&](Lens& l) { l.fStop = nan; }).find("f-number"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.focalLength = -50; }).find("focal length"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.focusDistance = 0; }).find("focus distance"), std::string::npos);
    EXPECT_NE(message([&](Lens& l) { l.focusDistance = nan; }).find("focus distance"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.bladeCount = 2; }).find("blade count"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.bladeCount = 1; }).find("blade count"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.exposureTime = -1; }).find("exposure time"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.iso = 0; }).find("ISO"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.focusTilt = std::numbers::pi / 2; }).find("focus tilt"), std::string::npos);
    EXPECT_NE(message([](Lens& l) { l.focusSwing = -std::numbers::pi / 2; }).find("focus swing"), std::string::npos);
    EXPECT_NE(message([](Lens& l) {
                  l.focusBreathing = true;
                  l.focusDistance = 0.05;
              }).find("focus breathing"),
              std::string::npos);
    EXPECT_EQ(message([](Lens&) {}), "");
}

}  // namespace
}  // namespace defocus::engine
