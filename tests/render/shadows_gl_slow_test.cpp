// Slow tests of shadows: with any number of samples drawn together, and with multirate and post-process methods.

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "image/metrics.h"
#include "render/shadowed.h"

namespace defocus::engine {
namespace {

TEST_F(Shadowed, sameBitsForEveryWave) {
    const auto small = fiveSpheres();
    small->view.width = 64;
    small->view.height = 48;
    const RenderSettings settings = settingsFor(70, Shadows::on);
    const Image one = shadowImage(*small, settings, "accumulation", 1);
    for (const std::uint32_t wave : {5u, 64u})
        EXPECT_EQ(shadowImage(*small, settings, "accumulation", wave).pixels, one.pixels) << wave;
}

TEST_F(Shadowed, multirateAndPostProcessDrawThemToo) {
    const auto small = fiveSpheres();
    small->view.width = 80;
    small->view.height = 60;
    const RenderSettings settings = settingsFor(64, Shadows::on);
    const Image accumulated = shadowImage(*small, settings);
    EXPECT_GT(compareImages(accumulated, shadowImage(*small, settings, "multirate")).psnr,
              35);  // a low bound, because multirate uses different sample points on the lights
    const auto edge = wall();
    addSun(*edge, {1, 0, 1}, glm::radians(20.0));
    addEdge(*edge, 1, 1);
    finish(*edge);
    const std::vector<double> shares = litShares(*edge, settingsFor(64, Shadows::on), "scheuermann");
    double max = 0;
    for (int x = 0; x < edge->view.width; ++x) {
        const double place = wallX(edge->view, x);
        if (std::abs(place) > 0.7) continue;
        max = std::max(max, std::abs(shares[static_cast<std::size_t>(x)] -
                                     litShareBehindEdge(place, 1, 1, std::tan(glm::radians(10.0)))));
    }
    EXPECT_LT(max, 0.12);  // tolerance for the noise of 4 pinhole images with 16 points on the sun each
}

}  // namespace
}  // namespace defocus::engine
