// Tests the brightness of near-mirrors at every level of detail.

#include <vector>

#include "render/mirror_ball.h"

namespace defocus::engine {
namespace {

// Under a uniform environment, a mirror has the environment's radiance at every level of detail.
TEST_F(Mirror, everyLevelIsAsBright) {
    const auto small = mirrorBall(0);
    const glm::vec3 white(1);
    small->world.environment = {EnvironmentType::uniform, white, white, white, nullptr, 1};
    small->world.environment.visible = false;
    const std::vector<PyramidLevel>& levels = small->world.pyramids[0].levels;
    ASSERT_GT(levels.size(), 5u);
    for (const double threshold : {0.01, 4.0, 16.0}) {  // px
        RenderSettings settings = ballSettings(16, 0);
        settings.lod = LodMode::nearest;
        settings.thresholds = {0.0, threshold};
        const Image image = ballImage(*small, settings);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (image.at(x, y)[3] == 0) continue;
                ASSERT_NEAR(image.at(x, y)[0] / image.at(x, y)[3], 1, 1e-3) << x << ' ' << y << ' ' << threshold;
            }
    }
}

}  // namespace
}  // namespace defocus::engine
