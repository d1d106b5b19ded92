#include "render/line/line_sets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

// Each spoke (line through the centre) of a polygonal aperture represents an equal fraction of the aperture's area. The
// part of this fraction that lies beyond a straight cut, averaged over all spokes, is therefore the fraction of the
// aperture's area beyond the cut.
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
        const auto backward = static_cast<double>(ray.values.x);
        const auto forwardShare = static_cast<double>(ray.values.y);
        const double u = static_cast<double>(ray.lensAndPixel.x);
        EXPECT_NEAR(std::abs(u) + std::abs(static_cast<double>(ray.lensAndPixel.y)), 1, 1e-5);
        const double edge = 0.5 / u;
        // Add κ, the fraction of the spoke's light beyond the cut at u = 1/2 (Tzeng et al. 2012). Only one end of the
        // spoke can reach beyond the cut: the forward end if u > 0, the backward end if u < 0.
        if (u > 0 && edge < 1) share += forwardShare * (1 - edge * edge);
        if (u < 0 && edge > -backward) share += (1 - forwardShare) * (1 - std::pow(edge / backward, 2));
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
