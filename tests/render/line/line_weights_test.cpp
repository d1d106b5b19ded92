#include "render/line/line_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/line/line_sets.h"

namespace defocus::engine {
namespace {

// Returns κ, the fraction of a lens line's light that passes between its points p1 and p2 (Tzeng et al. 2012). p runs
// from −1/2 to 1/2 along the line.
double kappa(double p1, double p2) {
    return lightBetween({}, 2 * p1, 2 * p2);
}

TEST(LineWeights, areThePapersKappa) {
    EXPECT_DOUBLE_EQ(kappa(-0.5, 0.5), 1);
    for (const double p1 : {-0.5, -0.2, 0.0, 0.1})
        for (const double p2 : {0.15, 0.3, 0.5})
            EXPECT_NEAR(kappa(p1, p2), 2 * (p2 * std::abs(p2) - p1 * std::abs(p1)), 1e-15);
}

TEST(LineWeights, addUp) {
    for (const LineLight& light : {LineLight{}, LineLight{0.8, 0.6, 0, 0}, LineLight{1, 0.5, 0.7, 0.2}}) {
        const double min = -light.backward;
        EXPECT_NEAR(lightBetween(light, min, 1), 1, 1e-15);
        double sum = 0;
        for (int i = 0; i < 50; ++i)
            sum += lightBetween(light, min + (1 - min) * i / 50, min + (1 - min) * (i + 1) / 50);
        EXPECT_NEAR(sum, 1, 1e-12);
    }
}

// A spoke is a line through the lens centre, and κ is the fraction of its light inside a region. Averaged over all
// spokes, κ equals the fraction of the disk that the region covers.
TEST(LineWeights, giveARegionItsShareOfTheDisk) {
    constexpr int lines = 20000;
    const double h = 0.3;  // the first region, u > h, is a circular segment
    double halfPlane = 0, offCentreDisk = 0;
    const double distance = 0.45, radius = 0.35;  // the second region is a disk beside the centre
    for (int i = 0; i < lines; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / lines;
        const double c = std::cos(angle);
        const double edge = h / c;
        if (std::abs(edge) < 1) halfPlane += c > 0 ? lightBetween({}, edge, 1) : lightBetween({}, -1, edge);
        const double square = radius * radius - distance * distance * (1 - c * c);
        if (square > 0)
            offCentreDisk += lightBetween({}, distance * c - std::sqrt(square), distance * c + std::sqrt(square));
    }
    EXPECT_NEAR(halfPlane / lines, (std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi, 1e-4);
    EXPECT_NEAR(offCentreDisk / lines, radius * radius, 1e-4);
}

TEST(LineWeights, anObstructedMiddleLetsNoLightPass) {
    const LineLight ring{1, 0.5, 0, 0.25};
    EXPECT_EQ(lightBetween(ring, -0.5, 0.5), 0);
    // a quarter of the light: the inner half, by area, of the ring's part on one side of the centre
    EXPECT_NEAR(lightBetween(ring, 0.5, std::sqrt((0.25 + 1) / 2)), 0.25, 1e-15);
}

// Each spoke (line through the centre) of a polygonal aperture represents an equal fraction of the aperture's area. The
// mean light of the spokes beyond a straight cut is therefore the fraction of the area beyond the cut.
TEST(LineSets, weighASquareByItsArea) {
    FramePlan plan;
    plan.view.lens.bladeCount = 4;
    plan.view.width = plan.view.height = 100;
    plan.samples.resize(512);
    const LineSets lines = lineSets(plan, true);
    // The square's corners lie on the axes. Its part with u > 1/2 is a half-size copy of its right half, so this part
    // has 1/8 of the square's area.
    double share = 0;
    for (const GpuRay& ray : lines.sets.table) {
        const LineLight light{ray.values.x, ray.values.y, 0, 0};
        const double u = static_cast<double>(ray.lensAndPixel.x);
        EXPECT_NEAR(std::abs(u) + std::abs(static_cast<double>(ray.lensAndPixel.y)), 1, 1e-5);
        const double edge = 0.5 / u;
        if (u > 0 && edge < 1) share += lightBetween(light, edge, 1);
        if (u < 0 && edge > -light.backward) share += lightBetween(light, -light.backward, edge);
    }
    EXPECT_NEAR(share / static_cast<double>(lines.sets.table.size()), 1.0 / 8, 1e-3);
}

TEST(LineSets, boundAllVariants) {
    FramePlan plan;
    plan.view.lens.bladeCount = 5;
    plan.view.width = 160;
    plan.view.height = 120;
    plan.samples.resize(12);
    const LineSets lines = lineSets(plan, true);
    for (std::uint32_t line = 0; line < 12; ++line)
        for (std::uint32_t variant = 0; variant < lines.sets.variants; ++variant) {
            const GpuRay& ray = lines.sets.table[line * lines.sets.variants + variant];
            for (const float p : {1.0f, -ray.values.x}) {
                const glm::vec2 lens = p * glm::vec2(ray.lensAndPixel);
                const glm::vec4& box = lines.sets.lensBounds[line];
                EXPECT_TRUE(lens.x >= box.x && lens.y >= box.y && lens.x <= box.z && lens.y <= box.w);
                const glm::vec2 way(lens.x, lens.y * 120 / 160);
                EXPECT_LE(std::abs(glm::dot(way, glm::vec2(lines.strips[line]))), lines.strips[line].z * 1.0001f);
            }
        }
}

}  // namespace
}  // namespace defocus::engine
