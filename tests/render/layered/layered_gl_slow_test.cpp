// Tests method "layered", which traces lens rays through depth layers, with method "accumulation" as the reference. The
// scenes have round surfaces. The lenses vary in aperture shape, blur controls and aberrations.

#include <functional>
#include <utility>
#include <vector>

#include "gl_conduct.h"
#include "render/layered/layered_images.h"

namespace defocus::engine {
namespace {

TEST_F(Layered, slopingAndRoundSurfacesAreAsTheAccumulationHasThem) {
    const auto small = fiveSpheres();
    const double error = rootMeanSquare(seenBy(*small, "layered"), seenBy(*small, "accumulation"));
    EXPECT_LT(error, 0.012);
    small->view.lens.fStop = 0.25;
    EXPECT_LT(rootMeanSquare(seenBy(*small, "layered"), seenBy(*small, "accumulation")), 0.012);
}

TEST_F(Layered, everyLensShapeAndControlIsTheAccumulations) {
    SKIP_ON_SECOND_DRIVER();
    const std::vector<std::pair<const char*, std::function<void(Lens&)>>> controls = {
        {"blades", [](Lens& lens) { lens.bladeCount = 3; }},
        {"cat's eye", [](Lens& lens) { lens.catEye = 1; }},
        {"anamorphic", [](Lens& lens) { lens.anamorphicRatio = 2; }},
        {"foreground limit", [](Lens& lens) { lens.foregroundLimit = 3; }},
        {"focus range", [](Lens& lens) { lens.focusRangeFront = 0.8; }},
        {"tilt", [](Lens& lens) { lens.focusTilt = 0.8; }},
        {"field curvature", [](Lens& lens) { lens.fieldCurvature = 0.3; }},
        {"axial chromatic aberration", [](Lens& lens) { lens.axialChromaticAberration = 0.3; }},
    };
    for (const auto& [name, set] : controls) {
        const auto small = fiveSpheres();
        small->view.lens.fStop = 0.5;
        const Image plain = seenBy(*small, "accumulation", 64);
        set(small->view.lens);
        const Image expected = seenBy(*small, "accumulation", 64);
        const double changed = rootMeanSquare(plain, expected);
        const double error = rootMeanSquare(seenBy(*small, "layered", 64), expected);
        EXPECT_LT(error, 0.02) << name;
        EXPECT_LT(error, 0.8 * changed) << name;
    }
}

}  // namespace
}  // namespace defocus::engine
