// Tests views that are widened beyond the frame. Each pixel must show the same point with the same blur as in the
// original view.

#include "render/layered/depth_layers.h"

#include <gtest/gtest.h>

#include <random>

namespace defocus::engine {
namespace {

TEST(Widened, keepsThePlacesAndTheBlursOfPixels) {
    FramePlan plan;
    plan.view.width = 120;
    plan.view.height = 70;
    plan.view.lens.focusDistance = 2;
    plan.view.lens.fStop = 0.5;
    plan.view.lens.focusTilt = 0.3;
    plan.view.lens.focusSwing = -0.2;
    plan.view.lens.fieldCurvature = 0.4;
    plan.view.lens.radialBlurGain = 0.7;
    plan.view.lens.foregroundLimit = 9;
    plan.view.lens.backgroundLimit = 7;
    plan.tanHalfHorizontal = 0.36;
    plan.coc = clipCircleOfConfusion(plan.view.lens, plan.view.width, plan.view.height);
    constexpr int border = 25;
    const FramePlan wide = widened(plan, border);
    const glm::dvec2 size(plan.view.width, plan.view.height);
    const glm::dvec2 wideSize(wide.view.width, wide.view.height);
    EXPECT_EQ(wideSize, size + 2.0 * border);

    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    double limited = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 pixel = size * glm::dvec2(unit(random), unit(random));
        const double z = 0.3 + 8 * unit(random) * unit(random);
        const glm::dvec2 ndc = 2.0 * pixel / size - 1.0;
        const glm::dvec2 wideNdc = 2.0 * (pixel + double(border)) / wideSize - 1.0;
        // Lateral offset of the point per unit of depth; the horizontal field of view scales both axes.
        const double tangent = ndc.y * plan.tanHalfHorizontal * size.y / size.x;
        EXPECT_NEAR(wideNdc.x * wide.tanHalfHorizontal, ndc.x * plan.tanHalfHorizontal, 1e-12);
        EXPECT_NEAR(wideNdc.y * wide.tanHalfHorizontal * wideSize.y / wideSize.x, tangent, 1e-12);
        const double blur = circleOfConfusion(plan.coc, z, plan.view.width, ndc);
        EXPECT_NEAR(circleOfConfusion(wide.coc, z, wide.view.width, wideNdc), blur, 1e-9);
        limited += std::abs(blur + 9) < 1e-9 ? 1 : 0;
    }
    EXPECT_GT(limited, 0);
}

}  // namespace
}  // namespace defocus::engine
