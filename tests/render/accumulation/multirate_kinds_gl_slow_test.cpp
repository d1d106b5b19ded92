// Tests method "multirate" with many kinds of surfaces and lenses. The tests are slow, because they render dozens of
// images of 256 samples.

#include <gtest/gtest.h>

#include <cmath>

#include "gl/context.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "render/accumulation/lens_cell_renders.h"

namespace defocus::engine {
namespace {

// Blended surfaces, environment maps and lenses with a blur limit look the same with method multirate as with method
// accumulation.
TEST(MultirateKinds, everyKindOfSurfaceAndLensStaysWhatItWas) {
    SKIP_ON_SECOND_DRIVER();
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const auto check = [](const SmallWorld& small, const char* what) {
        const RenderSettings settings = ratedSettings(256);
        const Difference difference =
            compareImages(drawnBy("accumulation", small, settings), drawnBy("multirate", small, settings));
        EXPECT_LT(difference.rmse, 0.012) << what;
        EXPECT_LT(std::abs(difference.mae), 0.004) << what;
    };
    auto small = fiveSpheres();
    small->view.lens.fStop = 0.25;
    small->view.width = 120;
    small->view.height = 90;
    check(*small, "spheres");
    Material glass = small->scene.materials[0];
    glass.alphaMode = AlphaMode::blend;
    glass.baseColorFactor = {1, 0.5f, 0.2f, 0.5f};
    small->scene.materials.push_back(glass);
    small->scene.meshes.push_back(bumpySphere(24, 16, 1));
    place(*small, 1, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.1, 0, -2.6)), glm::dvec3(0.3)));
    finish(*small);
    check(*small, "glass");
    auto map = std::make_shared<Image>(32, 16, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = static_cast<float>(i % 7) / 7;
    small->world.environment = {EnvironmentType::map, {}, {}, {}, map, 1};
    check(*small, "map");
    small->view.lens.focusTilt = 0.05;
    check(*small, "tilt");
    small->view.lens.catEye = 0.5;
    check(*small, "cat's eye");
    small->view.lens.catEye = 0;
    small->world.environment = {EnvironmentType::none, {}, {}, {}, nullptr, 1};
    check(*small, "transparent");
}

}  // namespace
}  // namespace defocus::engine
