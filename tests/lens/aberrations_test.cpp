#include "lens/aberrations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "lens/lens.h"

namespace defocus::engine {
namespace {

ClipCircleOfConfusion aberratedLens(double astigmatism, double coma) {
    const Lens lens{.fStop = 2, .focusDistance = 2, .astigmatism = astigmatism, .coma = coma};
    return clipCircleOfConfusion(lens, 1200, 800);
}

glm::dvec2 lensPoint(double radius, double angle) {
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

TEST(Aberrations, areTheGradientOfTheWavefront) {
    std::mt19937 source(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    const ClipCircleOfConfusion coc = aberratedLens(0.7, -1.3);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec2 ndc(unit(source), unit(source));
        const glm::dvec2 field(ndc.x, ndc.y / 1.5);
        const glm::dvec2 lens(unit(source), unit(source));
        const auto wavefront = [&](const glm::dvec2& l) {
            const double along = glm::dot(field, l);
            return coc.astigmatism * along * along / 2 + coc.coma * glm::dot(l, l) * along;
        };
        constexpr double step = 1e-4;
        const glm::dvec2 x(step, 0);
        const glm::dvec2 y(0, step);
        const glm::dvec2 gradient(wavefront(lens + x) - wavefront(lens - x), wavefront(lens + y) - wavefront(lens - y));
        const glm::dvec2 rays = aberration(coc, ndc, lens);
        EXPECT_NEAR(rays.x, gradient.x / (2 * step), 1e-8);
        EXPECT_NEAR(rays.y, gradient.y / (2 * step), 1e-8);
    }
}

// At the right edge of an image 36 mm wide, astigmatism turns a point into a line and coma into a comet. Each is as
// long as Lens::astigmatism or Lens::coma states in mm. Coma maps a circle on the lens to a circle that is traversed
// twice. All of these circles lie in a wedge of 60° whose apex is the point's image without coma.
TEST(Aberrations, areAsLongOnTheSensorAsTheySay) {
    const ClipCircleOfConfusion line = aberratedLens(0.9, 0);
    const double length = aberration(line, {1, 0}, {1, 0}).x - aberration(line, {1, 0}, {-1, 0}).x;
    EXPECT_NEAR(length / 2 * 36, 0.9, 1e-12);
    for (const double angle : {0.3, 1.9, 4.0}) EXPECT_EQ(aberration(line, {1, 0}, lensPoint(1, angle)).y, 0);

    const ClipCircleOfConfusion comet = aberratedLens(0, 0.9);
    EXPECT_NEAR(aberration(comet, {1, 0}, {1, 0}).x / 2 * 36, 0.9, 1e-12);
    for (const double radius : {0.4, 1.0})
        for (double angle = 0; angle < 6; angle += 0.7) {
            const double scale = comet.coma * radius * radius;
            const glm::dvec2 ray = aberration(comet, {1, 0}, lensPoint(radius, angle));
            EXPECT_NEAR(glm::length(ray - glm::dvec2(2 * scale, 0)), scale, 1e-12) << "a circle about twice its radius";
            EXPECT_NEAR(ray.y, scale * std::sin(2 * angle), 1e-12);
        }
}

TEST(Aberrations, reachHoldsEveryRayAndIsReached) {
    for (const auto& [astigmatism, coma] : {std::pair(0.8, 0.0), std::pair(0.0, -0.6), std::pair(0.8, 0.6)}) {
        const ClipCircleOfConfusion coc = aberratedLens(astigmatism, coma);
        double farthest = 0;
        for (double angle = 0; angle < 6.283; angle += 0.01)
            for (const double radius : {0.5, 1.0})
                farthest = std::max(farthest, glm::length(aberration(coc, {0.6, 0.9}, lensPoint(radius, angle))));
        const double reach = aberrationReach(coc, std::hypot(0.6, 0.9 / 1.5));
        EXPECT_LE(farthest, reach * (1 + 1e-12));
        EXPECT_GT(farthest, 0.999 * reach);
    }
}

// The max blur over a box bounds the deviation of every ray, aberrations included. Culling, level selection and shading
// rates rely on this bound.
TEST(Aberrations, widenTheRangeOfTheBlur) {
    const ClipCircleOfConfusion coc = aberratedLens(0.8, 0.6);
    const CocBox box{.zNear = 1.5, .zFar = 3, .ndcMin = {-0.2, 0.1}, .ndcMax = {0.9, 0.8}};
    const double largest = circleOfConfusionRange(coc, box, 1200).largest;
    std::mt19937 source(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 ndc(-0.2 + 1.1 * unit(source), 0.1 + 0.7 * unit(source));
        const glm::dvec2 lens = lensPoint(std::sqrt(unit(source)), 6.2832 * unit(source));
        const double blur = circleOfConfusion(coc, 1.5 + 1.5 * unit(source), 1200, ndc);
        EXPECT_LE(glm::length(blur * lens + 1200.0 * aberration(coc, ndc, lens)), largest * (1 + 1e-9));
    }
}

}  // namespace
}  // namespace defocus::engine
