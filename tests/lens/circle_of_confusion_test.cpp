#include "lens/circle_of_confusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <random>

namespace defocus::engine {
namespace {

Lens lensAt(double focusDistance) {
    return {.fStop = 1, .focusDistance = focusDistance};
}

// Returns a lens with a random subset of the blur controls.
Lens anyLens(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    Lens lens = lensAt(0.5 + 4 * unit(random));
    if (unit(random) < 0.5) lens.focusRangeFront = lens.focusDistance * 0.9 * unit(random);
    if (unit(random) < 0.5) lens.focusRangeBehind = 3 * unit(random);
    lens.focusRangeRefocuses = unit(random) < 0.3;
    if (unit(random) < 0.5) lens.focusTilt = 2 * unit(random) - 1;
    if (unit(random) < 0.5) lens.focusSwing = 2 * unit(random) - 1;
    if (unit(random) < 0.5) lens.fieldCurvature = 4 * unit(random) - 2;
    if (unit(random) < 0.5) lens.radialBlurGain = 3 * unit(random);
    if (unit(random) < 0.5) lens.foregroundLimit = 60 * unit(random);
    if (unit(random) < 0.5) lens.backgroundLimit = 30 * unit(random);
    return lens;
}

double random(std::mt19937& source, double min, double max) {
    return std::uniform_real_distribution<double>(min, max)(source);
}

// If the circle of confusion is C = a/w + b at depth w, a foreground limit R clamps C to −R at all depths
// w ≤ −a/(b + R). At larger depths, C is unchanged (Munkberg et al. 2012, Eq. 1 and 2 with inverted signs).
TEST(CircleOfConfusion, foregroundLimitHasItsKinkWhereThePaperSays) {
    Lens lens = lensAt(2);
    const ClipCircleOfConfusion free = clipCircleOfConfusion(lens, 1000, 750);
    lens.foregroundLimit = 20;
    const ClipCircleOfConfusion limited = clipCircleOfConfusion(lens, 1000, 750);
    const double kink = -free.a / (free.front + 20.0 / 1000);
    EXPECT_NEAR(circleOfConfusion(free, kink, 1000), -20, 1e-9);
    for (const double z : {0.01, 0.1, 0.5 * kink, kink}) EXPECT_NEAR(circleOfConfusion(limited, z, 1000), -20, 1e-9);
    for (const double z : {1.01 * kink, 2.0, 5.0, 1e9})
        EXPECT_EQ(circleOfConfusion(limited, z, 1000), circleOfConfusion(free, z, 1000));
}

TEST(CircleOfConfusion, backgroundLimitHasItsKinkBehindTheFocus) {
    Lens lens = lensAt(2);
    const ClipCircleOfConfusion free = clipCircleOfConfusion(lens, 1000, 750);
    lens.backgroundLimit = 10;
    const ClipCircleOfConfusion limited = clipCircleOfConfusion(lens, 1000, 750);
    const double kink = free.a / (10.0 / 1000 - free.behind);
    ASSERT_GT(kink, 2);
    EXPECT_NEAR(circleOfConfusion(free, kink, 1000), 10, 1e-9);
    EXPECT_NEAR(circleOfConfusion(limited, 2 * kink, 1000), 10, 1e-9);
    EXPECT_EQ(circleOfConfusion(limited, 1, 1000), circleOfConfusion(free, 1, 1000));
}

// The blur is zero in the entire focus range. Close to the lens and at infinity, it is the same as without a focus
// range. With Lens::focusRangeRefocuses, in contrast, the blur at infinity changes (Munkberg et al. 2012).
TEST(CircleOfConfusion, focusRangeIsSharpAndPreservesNearAndFarBlur) {
    Lens lens = lensAt(2);
    const ClipCircleOfConfusion plain = clipCircleOfConfusion(lens, 1000, 750);
    lens.focusRangeFront = 0.5;
    lens.focusRangeBehind = 3;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const bool refocuses : {false, true}) {
        lens.focusRangeRefocuses = refocuses;
        const ClipCircleOfConfusion range = clipCircleOfConfusion(lens, 1000, 750);
        for (const double z : {1.5, 1.7, 2.0, 4.0, 5.0}) EXPECT_NEAR(circleOfConfusion(range, z, 1000), 0, 1e-9);
        // The blur is continuous at both ends of the focus range.
        EXPECT_NEAR(circleOfConfusion(range, 1.5 * (1 - 1e-9), 1000), 0, 1e-5);
        EXPECT_NEAR(circleOfConfusion(range, 5 * (1 + 1e-9), 1000), 0, 1e-5);
        EXPECT_LT(circleOfConfusion(range, 1.4, 1000), -1);
        EXPECT_GT(circleOfConfusion(range, 5.5, 1000), 1);
        // Close to the lens, the focus range leaves the circle of confusion unchanged.
        EXPECT_NEAR(circleOfConfusion(range, 1e-6, 1000) / circleOfConfusion(plain, 1e-6, 1000), 1, 1e-5);
        // At infinity, the focus range leaves the circle of confusion unchanged. With focusRangeRefocuses, it becomes
        // that of a lens focused at 5 m, the far end of the range.
        const double far = circleOfConfusion(range, infinity, 1000) / circleOfConfusion(plain, infinity, 1000);
        EXPECT_NEAR(far, refocuses ? 2.0 / 5 : 1, 1e-12);
        // The focus range ends at 5 m. At depth z = 8 m, the circle of confusion is A·W/(2·tan(θx/2)) times
        // (1/s)·(1 − 5/z), or times (1/5 − 1/z) with focusRangeRefocuses. A is the aperture diameter, W the image width
        // in px, θx the horizontal field of view and s the focus distance.
        const double atInfinity = circleOfConfusion(plain, infinity, 1000);
        EXPECT_NEAR(circleOfConfusion(range, 8, 1000),
                    refocuses ? atInfinity * 2 * (1.0 / 5 - 1.0 / 8) : atInfinity * (1 - 5.0 / 8), 1e-9);
    }
}

TEST(CircleOfConfusion, tiltedPlaneIsInFocus) {
    Lens lens = lensAt(3);
    lens.focusTilt = 0.7;
    lens.focusSwing = -0.4;
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1200, 800);
    const double tanX = tanHalfHorizontalFov(lens);
    for (const double x : {-0.5, 0.0, 0.8})
        for (const double y : {-0.6, 0.3}) {
            const double z = 3 - std::tan(-0.4) * x - std::tan(0.7) * y;  // depth of the focus plane in view space, m
            const glm::dvec2 ndc(x / (z * tanX), y / (z * tanX) * 1.5);
            EXPECT_NEAR(circleOfConfusion(coc, z, 1200, ndc), 0, 1e-9);
        }
}

TEST(CircleOfConfusion, curvedFocusSurfaceIsWhereDesignSays) {
    Lens lens = lensAt(3);
    lens.fieldCurvature = 0.8;
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1200, 800);
    for (const glm::dvec2 ndc : {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(-0.3, 0.9)}) {
        const double radius2 = ndc.x * ndc.x + ndc.y * ndc.y / 2.25;
        EXPECT_NEAR(circleOfConfusion(coc, 3 / (1 + 0.8 * radius2), 1200, ndc), 0, 1e-9);
    }
}

// The range of the circle of confusion C over a box contains C at every point of the box. Level selection and culling
// rely on this range.
TEST(CircleOfConfusion, rangeOverABoxHoldsEveryPointOfIt) {
    std::mt19937 source(7);
    for (int trial = 0; trial < 400; ++trial) {
        const ClipCircleOfConfusion coc = clipCircleOfConfusion(anyLens(source), 1000, 600);
        CocBox box;
        box.zNear = random(source, 0.1, 5);
        box.zFar = box.zNear + random(source, 0, 5);
        box.ndcMin = {random(source, -1.2, 1), random(source, -1.2, 1)};
        box.ndcMax = box.ndcMin + glm::dvec2(random(source, 0, 1), random(source, 0, 1));
        box.own.factorMin = random(source, 0, 1);
        box.own.factorMax = box.own.factorMin + random(source, 0, 1);
        box.own.addedMin = random(source, -0.05, 0.05);
        box.own.addedMax = box.own.addedMin + random(source, 0, 0.05);
        const CocRange range = circleOfConfusionRange(coc, box, 1000);
        for (int i = 0; i < 50; ++i) {
            const glm::dvec2 ndc(random(source, box.ndcMin.x, box.ndcMax.x),
                                 random(source, box.ndcMin.y, box.ndcMax.y));
            const double c = circleOfConfusion(coc, random(source, box.zNear, box.zFar), 1000, ndc,
                                               random(source, box.own.factorMin, box.own.factorMax),
                                               random(source, box.own.addedMin, box.own.addedMax));
            const double slack = 1e-9 * (1 + range.largest);
            EXPECT_GE(c, range.nearest - slack);
            EXPECT_LE(c, range.farthest + slack);
            EXPECT_GE(std::abs(c), range.smallest - slack);
            EXPECT_LE(std::abs(c), range.largest + slack);
        }
    }
}

// The circle of confusion C is interpolated linearly in depth w along an edge from the near plane, where triangles are
// clipped, to a vertex whose blur is limited. The interpolated blur |C/w| doesn't exceed the foreground limit (Munkberg
// et al. 2012, 4.1).
TEST(CircleOfConfusion, limitHoldsUpToTheNearPlane) {
    Lens lens = lensAt(2);
    lens.foregroundLimit = 15;
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, 1000, 750);
    const double near = 0.01;
    const double kink = -coc.a / (coc.front + 15.0 / 1000);
    const auto clip = [&](double w) { return w * circleOfConfusion(coc, w, 1000) / 1000; };
    for (const double far : {0.02, 0.5 * kink, kink})
        for (double w = near; w <= far; w *= 1.07) {
            const double t = (w - near) / (far - near);
            const double linear = (1 - t) * clip(near) + t * clip(far);
            EXPECT_LE(std::abs(linear / w) * 1000, 15 * (1 + 1e-12)) << "w = " << w;
        }
    // On an edge that is not clipped at the near plane and starts behind the camera, at w = −1, the interpolated blur
    // exceeds the limit.
    const double behind = -1;
    const double t = (near - behind) / (kink - behind);
    const double uncut = (1 - t) * (coc.a + coc.front * behind) + t * clip(kink);
    EXPECT_GT(std::abs(uncut / near) * 1000, 15);
}

// Along random edges, the circle of confusion deviates from linear interpolation between the edge's ends by no more
// than cocDeviation().
TEST(CircleOfConfusion, deviationBoundHoldsForEdgesInTheBox) {
    std::mt19937 source(11);
    const int width = 1000;
    int large = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Lens lens = anyLens(source);
        const ClipCircleOfConfusion coc = clipCircleOfConfusion(lens, width, 600);
        const double tanX = tanHalfHorizontalFov(lens);
        const glm::dvec2 tanHalf(tanX, tanX * 0.6);
        glm::dvec3 ends[2];  // view-space x and y, and depth
        for (glm::dvec3& end : ends) {
            end.z = random(source, 0.5, 4);
            end.x = random(source, -1, 1) * tanHalf.x * end.z;
            end.y = random(source, -1, 1) * tanHalf.y * end.z;
        }
        const double shrink = std::pow(10.0, random(source, -3, 0));
        ends[1] = ends[0] + (ends[1] - ends[0]) * shrink;
        const auto ndcOf = [&](const glm::dvec3& p) { return glm::dvec2(p) / (tanHalf * p.z); };
        // In every second trial, the blur attributes vary linearly along the edge.
        const bool vary = trial % 2 == 0;
        const glm::dvec2 factors(random(source, 0, 2), random(source, 0, 2));
        const glm::dvec2 added(random(source, -0.05, 0.05), random(source, -0.05, 0.05));
        const auto at = [](const glm::dvec2& values, double t) { return values.x + t * (values.y - values.x); };
        const auto clip = [&](double t) {
            const glm::dvec3 p = ends[0] + t * (ends[1] - ends[0]);
            const double factor = vary ? at(factors, t) : factors.x;
            return p.z * circleOfConfusion(coc, p.z, width, ndcOf(p), factor, vary ? at(added, t) : added.x);
        };
        CocBox box{std::min(ends[0].z, ends[1].z), std::max(ends[0].z, ends[1].z)};
        box.ndcMin = glm::min(ndcOf(ends[0]), ndcOf(ends[1]));
        box.ndcMax = glm::max(ndcOf(ends[0]), ndcOf(ends[1]));
        box.own = {factors.x, factors.x, added.x, added.x};
        if (vary)
            box.own = {std::min(factors.x, factors.y), std::max(factors.x, factors.y), std::min(added.x, added.y),
                       std::max(added.x, added.y)};
        const CocDeviation bound = cocDeviation(coc, box, glm::length(ends[1] - ends[0]), tanHalf, width);
        double deviation = 0;
        for (double t = 0; t <= 1; t += 0.05) {
            const glm::dvec3 p = ends[0] + t * (ends[1] - ends[0]);
            const double chord = (1 - t) * clip(0) + t * clip(1);
            deviation = std::max(deviation, std::abs(clip(t) - chord) / p.z);
        }
        EXPECT_LE(deviation, bound.kinks + bound.curved + 1e-6) << "trial " << trial;
        large += deviation > 0.5 ? 1 : 0;
    }
    EXPECT_GT(large, 300) << "some edges must deviate";
}

}  // namespace
}  // namespace defocus::engine
