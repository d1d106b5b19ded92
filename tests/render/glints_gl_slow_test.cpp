// Tests glints of a glossy surface that are far smaller than a pixel. A filter that spreads glints keeps their mean
// radiance, and its bias falls as the number of samples grows.

#include <gtest/gtest.h>

#include "gl_context_test.h"
#include "likeness.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using Glints = GlContextTest;

// Returns a ball about 40 px across with ripples that are 5 to 10 px long.
std::unique_ptr<SmallWorld> rippledBall(float roughness, float metallic) {
    auto small = std::make_unique<SmallWorld>();
    const Material glossy{
        .baseColorFactor = metallic > 0 ? glm::vec4(0.8f, 0.8f, 0.8f, 1) : glm::vec4(0.02f, 0.02f, 0.02f, 1),
        .metallicFactor = metallic,
        .roughnessFactor = roughness};
    small->scene.materials.push_back(glossy);
    small->scene.meshes.push_back(bumpySphere(112, 88, 0));
    small->scene.meshes.back().vertices.colors.clear();
    place(*small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4)));
    small->world.environment.type = EnvironmentType::none;
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.dofEnabled = false;
    small->world.pyramids = {fullDetail(small->scene.meshes[0])};
    return small;
}

// Returns suns in all directions, evenly on a spiral from pole to pole (Vogel 1979). With a single sun, the result
// would depend on the positions of the ripples' caustics. `set` selects the offsets in height and azimuth, which are
// the same for all suns.
std::vector<PlacedLight> sunsAllAround(std::uint32_t set) {
    constexpr int count = 60;
    std::vector<PlacedLight> suns;
    for (int i = 0; i < count; ++i) {
        const double height = 1 - 2 * (i + radicalInverse(2, set)) / count;
        const double azimuth = 2 * std::numbers::pi * ((2 - std::numbers::phi) * i + radicalInverse(3, set));
        const double radius = std::sqrt(1 - height * height);
        suns.push_back(sunFrom({radius * std::cos(azimuth), height, radius * std::sin(azimuth)}, 0.5f));
    }
    return suns;
}

// Renders the ball with or without the filter that spreads glints. The filter acts on a frame's first samples only, so
// unfiltered images use sample indices from 2²⁰ on.
Image ballImage(const SmallWorld& small, std::uint32_t samples, bool filtered) {
    const RenderSettings settings{
        .sampleCount = samples, .firstSample = filtered ? 0 : 1u << 20, .lod = LodMode::off, .keepAll = true};
    return imageInFloats(small.world, planFrame(small.world, small.view, settings));
}

// Returns the root mean square difference of the images' red values, which are clamped to 1 as on a display.
double displayError(const Image& image, const Image& converged) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double off = std::min(image.at(x, y)[0], 1.0f) - std::min(converged.at(x, y)[0], 1.0f);
            sum += off * off;
        }
    return std::sqrt(sum / (static_cast<double>(image.width) * image.height));
}

// Returns the largest ratio of a pixel to the brightest of the 3 × 3 converged pixels around it. The brightest pixel is
// clamped to at least 0.05.
double worstPixel(const Image& image, const Image& converged) {
    double worst = 0;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            float brightest = 0.05f;
            for (int row = y - 1; row <= y + 1; ++row)
                for (int column = x - 1; column <= x + 1; ++column)
                    brightest = std::max(brightest, converged.at(column, row)[0]);
            worst = std::max<double>(worst, image.at(x, y)[0] / brightest);
        }
    return worst;
}

// The error is measured against a converged image, because white pixels alone are no error: a glint smaller than a
// pixel can be bright enough to make the entire pixel white.
TEST_F(Glints, convergeWithinTheFirstSamples) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.05f, 0.2f})
            for (const glm::dvec3& way : {glm::dvec3(1, -0.3, -0.2), glm::dvec3(-0.3, -0.8, -1)}) {
                const auto small = rippledBall(roughness, metallic);
                small->world.lights = {sunFrom(way, 3)};
                const Image converged = ballImage(*small, 1024, false);
                const double few = displayError(ballImage(*small, 16, true), converged);
                const double more = displayError(ballImage(*small, 64, true), converged);
                EXPECT_LT(few, 0.08) << roughness << ' ' << metallic << ' ' << way.x;
                EXPECT_LT(more, 0.75 * few) << roughness << ' ' << metallic << ' ' << way.x;
            }
}

TEST_F(Glints, fewSamplesMakeNoWhitePixelsOfTheirOwn) {
    for (const float metallic : {0.0f, 1.0f})
        for (const glm::dvec3& way : {glm::dvec3(1, -0.3, -0.2), glm::dvec3(-0.3, -0.8, -1)}) {
            const auto small = rippledBall(0.2f, metallic);
            small->world.lights = {sunFrom(way, 3)};
            const Image converged = ballImage(*small, 1024, false);
            for (const std::uint32_t samples : {16u, 64u})
                EXPECT_LT(worstPixel(ballImage(*small, samples, true), converged), 3.5)
                    << metallic << ' ' << way.x << ' ' << samples;
        }
}

TEST_F(Glints, spreadingThemKeepsTheirLight) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.3f, 0.5f}) {
            const auto small = rippledBall(roughness, metallic);
            double few = 0, many = 0;
            for (std::uint32_t set = 0; set < 4; ++set) {
                small->world.lights = sunsAllAround(set);
                few += meanRed(ballImage(*small, 16, true));
                many += meanRed(ballImage(*small, 64, false));
            }
            EXPECT_NEAR(few, many, 0.02 * many) << roughness << ' ' << metallic << ' ' << few / many - 1;
        }
}

}  // namespace
}  // namespace defocus::engine
