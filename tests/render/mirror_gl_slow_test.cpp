// Tests that the highlight of a near-mirror, which is far smaller than a pixel, has the right energy with few samples.

#include "render/mirror_ball.h"

namespace defocus::engine {
namespace {

// A mirror ball of radius r under a sun of illuminance E has the radiant intensity E·r²/4 in every direction. The image
// must show it although the sun's highlight is far smaller than a pixel and few or no samples hit it.
TEST_F(Mirror, aBallSendsTheSunsLightToAllSidesAlike) {
    for (const float roughness : {0.0f, 0.05f, 0.2f})
        for (const glm::dvec3& way : {glm::dvec3(-0.3, -0.8, -1), {1, -0.3, -0.2}, {0.6, 0.7, -0.5}}) {
            const auto small = mirrorBall(roughness);
            small->world.lights = {sunFrom(way, 3)};
            const double expected = 3 * ballRadius * ballRadius / 4 / (ballDepth * ballDepth);
            for (std::uint32_t seed = 0; seed < 3; ++seed)
                EXPECT_NEAR(intensityOf(ballImage(*small, ballSettings(64, seed))), expected, 0.06 * expected)
                    << roughness << ' ' << way.x << ' ' << seed;
        }
}

}  // namespace
}  // namespace defocus::engine
