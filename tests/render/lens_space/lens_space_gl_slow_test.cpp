// Slow tests of both lens-space methods against method "accumulation": tens of thousands of blurred triangles in one
// tile, and motion blur.

#include <string>

#include "gl_conduct.h"
#include "render/lens_space/lens_space_images.h"

namespace defocus::engine {
namespace {

// Tens of thousands of blurred triangles, hundreds of them on each lens line, form the same white square as two large
// triangles.
TEST_P(LensSpace, seesTensOfThousandsOfBlurredTrianglesInATileAsTheirSquare) {
    SKIP_ON_SECOND_DRIVER();
    const auto blurred = [](std::uint32_t side) {
        auto small = gridInATile(side);
        small->view.lens.dofEnabled = true;
        small->view.lens.focusDistance = 2.5;
        small->view.lens.fStop = 0.6;
        return small;
    };
    const bool lines = std::string(GetParam()) == "line";
    const auto square = blurred(1);
    const Image reference = imageInFloats(square->world, planFrame(square->world, square->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *blurred(longerThanLoops), lines ? 24 : 64)), 40);
}

TEST_F(LensSpaceAlone, stochasticPointsBlurMotion) {
    const auto small = twoSpheres();
    small->world.shutter.poses.assign(3, small->world.pose);
    for (int i = 0; i < 3; ++i)
        small->world.shutter.poses[static_cast<std::size_t>(i)].objects[0].worldFromObject =
            glm::scale(glm::translate(glm::dmat4(1), {-0.35 + 0.15 * i, -0.1, -1.4 + 0.1 * i * i}), glm::dvec3(0.2));
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage("stochastic", *small, 256)), 50);
    expectRefusal("line", *small, "motion blur is not supported");
    small->world.shutter.perSample = true;
    small->world.shutter.poses.push_back(small->world.shutter.poses.back());  // four poses, one for each sample
    expectRefusal("stochastic", *small, "motion segments");
}

INSTANTIATE_TEST_SUITE_P(Methods, LensSpace, testing::Values("stochastic", "line"));

}  // namespace
}  // namespace defocus::engine
