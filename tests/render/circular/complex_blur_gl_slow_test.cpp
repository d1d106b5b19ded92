// Slow tests of the disk blur with complex Gaussians, in one pass along rows and one along columns.

#include <utility>

#include "gl_conduct.h"
#include "render/circular/blurred_blocks.h"

namespace defocus::engine {
namespace {

// Blurring rows and then columns gives the same image as direct convolution with the two-dimensional kernel.
TEST_F(ComplexBlurs, twoPassesGiveTheWholeKernel) {
    SKIP_ON_SECOND_DRIVER();
    for (const ComplexTaps taps : {ComplexTaps::exact, ComplexTaps::eight})
        for (int components = 1; components <= circularKernelLimit; ++components)
            for (const float radius : {0.3f, 1.0f, 2.7f, 9.0f}) {
                ComplexBlurInfo info = infoOf(components);
                info.width /= 2;
                info.height /= 2;
                info.taps = taps;
                const Image passes = blurred(info, partOf(blocks()), partOf(filled(1, radius)));
                info.direct = true;
                const Image full = blurred(info, partOf(blocks()), partOf(filled(1, radius)));
                EXPECT_LT(largestDifference(passes, full), 1e-3)
                    << components << " components, radius " << radius << ", taps " << static_cast<int>(taps);
            }
}

TEST_F(ComplexBlurs, twoPassesGiveTheWholeOval) {
    SKIP_ON_SECOND_DRIVER();
    for (const ComplexTaps taps : {ComplexTaps::exact, ComplexTaps::eight})
        for (const int components : {1, 2, circularKernelLimit})
            for (const auto& [across, upwards] : {std::pair(0.5, 1.0), std::pair(1.0, 0.7)}) {
                ComplexBlurInfo info = infoOf(components);
                info.width /= 2;
                info.height /= 2;
                info.across = across;
                info.upwards = upwards;
                info.taps = taps;
                const Image passes = blurred(info, partOf(blocks()), partOf(filled(1, 9)));
                info.direct = true;
                EXPECT_LT(largestDifference(passes, blurred(info, partOf(blocks()), partOf(filled(1, 9)))), 1e-3)
                    << components << " components, " << across << ", taps " << static_cast<int>(taps);
            }
}

}  // namespace
}  // namespace defocus::engine
