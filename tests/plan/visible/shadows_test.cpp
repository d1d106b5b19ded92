// Tests which lights cast shadows, how directions to the sky are chosen, and how large shadow maps are.
#include "plan/visible/shadows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>

#include "plan/visible/light_shares.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

constexpr double wallDepth = 4;  // m

// Returns a wall of 8 m width at z = −4 m, in front of a pinhole camera at the origin. The image shows the middle 2.9 m
// of the wall.
std::unique_ptr<SmallWorld> wallWithoutLights() {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.emplace_back();
    small->scene.meshes.push_back(quad(0));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -wallDepth}), glm::dvec3(4)));
    small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    small->view.width = 320;
    small->view.height = 240;
    small->view.lens.dofEnabled = false;
    return small;
}

void addLight(SmallWorld& small, LightType type, double intensity, const glm::dvec3& position) {
    PlacedLight placed;
    placed.light.type = type;
    placed.light.intensity = static_cast<float>(intensity);
    placed.light.radius = 0;
    placed.position = position;
    small.world.lights.push_back(placed);
}

RenderSettings withShadows() {
    return {.sampleCount = 64, .shadows = Shadows::on};
}

FramePlan shadowedPlan(SmallWorld& small) {
    finish(small);
    return planFrame(small.world, small.view, withShadows());
}

std::vector<double> sharesOf(SmallWorld& small) {
    const FramePlan plan = shadowedPlan(small);
    return lightShares(small.world, plan, seenPoints(plan));
}

// A lamp of 1600·E candela that is 40 m from the wall illuminates the wall as much as a sun of E lux.
TEST(ShadowPlan, lightsCountByTheirIlluminanceOfTheImage) {
    const auto small = wallWithoutLights();
    addLight(*small, LightType::directional, 2, {});
    addLight(*small, LightType::point, 1600 * 6, {0, 0, 40 - wallDepth});
    const std::vector<double> shares = sharesOf(*small);
    ASSERT_EQ(shares.size(), 3U);
    EXPECT_NEAR(shares[0], 0.25, 0.01);
    EXPECT_NEAR(shares[1], 0.75, 0.01);
    EXPECT_EQ(shares[2], 0);
}

// A uniform sky of radiance L illuminates an unoccluded surface with π·L lux.
TEST(ShadowPlan, aUniformSkyCountsByItsIlluminance) {
    const auto small = wallWithoutLights();
    addLight(*small, LightType::directional, std::numbers::pi, {});
    small->world.environment = {EnvironmentType::uniform, glm::vec3(1), glm::vec3(1), glm::vec3(1), nullptr, 1};
    const std::vector<double> shares = sharesOf(*small);
    EXPECT_NEAR(shares[0], 0.5, 1e-3);
    EXPECT_NEAR(shares[1], 0.5, 1e-3);
}

// A weak lamp 0.3 m from the wall illuminates the nearest part of the wall more than the sun does. At a distance equal
// to the scene's radius, the lamp would give only 0.2 % of the sun's illuminance.
TEST(ShadowPlan, aWeakLampNearASurfaceCastsShadows) {
    const auto small = wallWithoutLights();
    addLight(*small, LightType::directional, 2, {});
    addLight(*small, LightType::point, 0.15, {0.1, 0.2, 0.3 - wallDepth});
    const FramePlan plan = shadowedPlan(*small);
    EXPECT_TRUE(std::ranges::any_of(plan.shadows.maps, [](const ShadowMap& map) { return map.light == 1; }));
}

TEST(ShadowPlan, aLampThatTheImageDoesNotShowCastsNoShadow) {
    const auto small = wallWithoutLights();
    addLight(*small, LightType::directional, 2, {});
    addLight(*small, LightType::point, 0.15, {3.8, 0.2, 0.3 - wallDepth});  // a lamp near the edge of the wall
    const FramePlan plan = shadowedPlan(*small);
    ASSERT_EQ(plan.shadows.maps.size(), 1U);
    EXPECT_EQ(plan.shadows.maps.front().light, 0);
}

// On the wall, a shadow-map texel is at most two pixels and at least half a pixel wide.
TEST(ShadowPlan, texelsAreAsSmallAsPixels) {
    for (const bool local : {false, true}) {
        const auto small = wallWithoutLights();
        addLight(*small, local ? LightType::point : LightType::directional, 100, {0, 0, 8 - wallDepth});
        const FramePlan plan = shadowedPlan(*small);
        const ShadowProjection projection = shadowProjections(small->world, plan, {}).front();
        const double texel = projection.texel * (local ? 8 : 1);
        const double pixel = 2 * plan.tanHalfHorizontal * wallDepth / small->view.width;
        EXPECT_LE(texel, 2.02 * pixel);
        EXPECT_GE(texel, 0.5 * pixel);
    }
}

// A floor that reaches from near to far needs more shadow-map texels than the image has pixels. Where the floor is out
// of focus, no texel needs to be smaller than the blur.
TEST(ShadowPlan, texelsAreAsLargeAsTheBlurHides) {
    const auto sizeOf = [](bool blurred) {
        auto small = wallWithoutLights();
        small->world.pose.objects.clear();
        const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), {0, -1, -51}), -1.5707963, {1, 0, 0});
        place(*small, 0, glm::scale(turned, glm::dvec3(50)));
        small->view.lens.dofEnabled = blurred;
        small->view.lens.focusDistance = 90;
        small->view.lens.fStop = 0.2;
        addLight(*small, LightType::directional, 1, {});
        small->world.lights.back().direction = {0, -1, 0};
        return shadowedPlan(*small).shadows.size;
    };
    EXPECT_GT(sizeOf(false), 320);
    EXPECT_LT(sizeOf(true), sizeOf(false));
}

// Directions to the sky can be chosen for surfaces of any orientation or only for a horizontal ground. Both choices
// estimate the same irradiance of the ground: π under a uniform sky of radiance 1, and π·2/3 under a sky of radiance
// cos θ. The choice for a ground has less than half the variance.
TEST(EnvironmentDirections, directionsForAGroundEstimateTheSameIrradiance) {
    for (const bool uniform : {true, false}) {
        Environment environment;
        environment.type = uniform ? EnvironmentType::uniform : EnvironmentType::gradient;
        environment.zenith = glm::vec3(1);
        if (uniform) environment.horizon = environment.nadir = glm::vec3(1);
        std::array<double, 2> variances{};
        for (const bool onGround : {false, true}) {
            const EnvironmentDirections directions(environment, onGround);
            double sum = 0;
            double squares = 0;
            constexpr int count = 256;
            for (int i = 0; i < count * count; ++i) {
                const EnvironmentDirections::Choice choice =
                    directions.at({(i % count + 0.5) / count, (i / count + 0.5) / count});
                const double received = std::max(0.0, choice.toLight.y) * choice.radiance.g;
                sum += received;
                squares += received * received;
            }
            const double mean = sum / (count * count);
            EXPECT_NEAR(mean, std::numbers::pi * (uniform ? 1 : 2.0 / 3), 0.01);
            variances.at(onGround ? 1 : 0) = squares / (count * count) - mean * mean;
        }
        EXPECT_LT(variances[1], 0.5 * variances[0]);
    }
}

}  // namespace
}  // namespace defocus::engine
