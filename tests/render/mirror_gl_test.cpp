// Near-mirrors: their brightness at every level of detail, and the convergence of their highlights.

#include <gtest/gtest.h>

#include "gl/context.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Mirror : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }

private:
    static inline std::unique_ptr<GlContext> context_;
};

constexpr double ballDepth = 200;  // m: so far that reflected light leaves in one direction
constexpr double ballRadius = 1;
constexpr double ballFocalLength = 2000;  // mm

// A smooth ball of white metal, about 36 px across in 64 × 48 px.
std::unique_ptr<SmallWorld> mirrorBall(float roughness) {
    auto small = std::make_unique<SmallWorld>();
    Material metal;
    metal.roughnessFactor = roughness;
    small->scene.materials.push_back(metal);
    Mesh ball = bumpySphere(128, 64, 0);
    for (std::size_t v = 0; v < ball.vertices.count(); ++v) {
        ball.vertices.positions[v] = glm::normalize(ball.vertices.positions[v]);
        ball.vertices.normals[v] = ball.vertices.positions[v];
    }
    ball.vertices.colors.clear();
    small->scene.meshes.push_back(std::move(ball));
    place(*small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -ballDepth)));
    small->world.environment.type = EnvironmentType::none;
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.focalLength = ballFocalLength;
    small->view.lens.dofEnabled = false;
    finish(*small);
    return small;
}

Image ballImage(const SmallWorld& small, const RenderSettings& settings) {
    return imageInFloats(small.world, planFrame(small.world, small.view, settings));
}

// Returns ∫ L dΩ over the image's red channel.
double intensityOf(const Image& image) {
    const double pixel = 36.0 / ballFocalLength / image.width;  // pixel size on the image plane at distance 1
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double right = (x + 0.5 - 0.5 * image.width) * pixel;
            const double up = (y + 0.5 - 0.5 * image.height) * pixel;
            sum += static_cast<double>(image.at(x, y)[0]) * pixel * pixel * std::pow(1 + right * right + up * up, -1.5);
        }
    return sum;
}

RenderSettings ballSettings(std::uint32_t samples, std::uint32_t seed) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.seed = seed;
    settings.lod = LodMode::off;
    return settings;
}

// A mirror ball of radius r under a sun of illuminance E sends the intensity E·r²/4 in all directions. Few samples meet
// a highlight far smaller than a pixel, or none.
TEST_F(Mirror, aBallSendsTheSunsLightToAllSidesAlike) {
    for (const float roughness : {0.0f, 0.05f, 0.2f})
        for (const glm::dvec3& way : {glm::dvec3(-0.3, -0.8, -1), {1, -0.3, -0.2}, {0.6, 0.7, -0.5}}) {
            const auto small = mirrorBall(roughness);
            PlacedLight sun;
            sun.light.intensity = 3;
            sun.direction = glm::normalize(way);
            small->world.lights = {sun};
            const double expected = 3 * ballRadius * ballRadius / 4 / (ballDepth * ballDepth);
            for (std::uint32_t seed = 0; seed < 3; ++seed)
                EXPECT_NEAR(intensityOf(ballImage(*small, ballSettings(64, seed))), expected, 0.06 * expected)
                    << roughness << ' ' << way.x << ' ' << seed;
        }
}

// Under uniform light, a mirror is as bright as that light at every level of detail.
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
