// Tests the radiance of each pixel under directional, point and spot lights against glTF's equations in double
// precision.

#include <gtest/gtest.h>

#include "render/lit_wall.h"

namespace defocus::engine {
namespace {

using PunctualLights = LitWall;

Material materialOf(const GltfSurface& surface) {
    return {.baseColorFactor = glm::vec4(surface.baseColor, 1),
            .metallicFactor = static_cast<float>(surface.metallic),
            .roughnessFactor = static_cast<float>(surface.roughness)};
}

// Returns the change in radiance over 1/512 px, or 0 for software rasterizers. GPUs round vertex positions to a grid
// of 1/256 px, so interpolated positions have errors up to half a grid step.
glm::dvec3 overHalfAGridStep(const GltfSurface& surface, const WallPoint& point, const std::vector<PlacedLight>& lights,
                             const SmallWorld& small) {
    if (currentIsSoftware()) return glm::dvec3(0);
    const double step = 0.72 * wallDepth / small.view.width / 512;
    const glm::dvec3 expected = litRadiance(surface, point, point.normal, lights);
    glm::dvec3 max(0);
    for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
        WallPoint beside = point;
        beside.position += step * fromWall(small, way);
        beside.toEye = glm::normalize(glm::dvec3(small.view.worldFromCamera[3]) - beside.position);
        max = glm::max(max, glm::abs(litRadiance(surface, beside, point.normal, lights) - expected));
    }
    return max;
}

void expectClosedForm(const GltfSurface& surface, const std::vector<PlacedLight>& lights, const SmallWorld& small) {
    const Image image = wallImage(small);
    double brightest = 0;
    for (const WallPoint& point : wallPoints(small)) {
        const glm::dvec3 expected = litRadiance(surface, point, point.normal, lights);
        expectLitRadiance(image, point, expected, surface.roughness, overHalfAGridStep(surface, point, lights, small));
        if (testing::Test::HasFatalFailure()) return;
        brightest = std::max(brightest, expected.x);
    }
    EXPECT_GT(brightest, 1e-3) << "the light reaches the wall";
}

// Returns a lamp 1.2 m in front of the wall, beside the wall's centre.
PlacedLight lampBefore(const SmallWorld& small) {
    PlacedLight lamp;
    lamp.light.type = LightType::point;
    lamp.light.color = {1, 0.6f, 0.3f};
    lamp.light.intensity = 6;
    lamp.position = glm::dvec3(small.view.worldFromCamera * glm::dvec4(0.3, -0.2, 1.2 - wallDepth, 1));
    return lamp;
}

TEST_F(PunctualLights, aSunOnEveryKindOfSurface) {
    for (const double metallic : {0.0, 0.4, 1.0})
        for (const double roughness : {0.2, 0.5, 1.0}) {
            const GltfSurface surface{{0.9, 0.5, 0.1}, metallic, roughness};
            const auto small = litWall(materialOf(surface));
            for (const glm::dvec3& way : {glm::dvec3(0, 0, -1), {0.6, 0.2, -1}, {-3, 1, -1}}) {
                small->world.lights = {sunFrom(fromWall(*small, way), 3)};
                SCOPED_TRACE(testing::Message() << metallic << ' ' << roughness << ' ' << way.x);
                expectClosedForm(surface, small->world.lights, *small);
            }
        }
}

TEST_F(PunctualLights, aSunBehindTheWallLightsNothing) {
    const auto small = litWall(materialOf({}));
    small->world.lights = {sunFrom(fromWall(*small, {0.5, 0, 1}), 3)};
    const Image image = wallImage(*small);
    for (const WallPoint& point : wallPoints(*small)) ASSERT_EQ(image.at(point.x, point.y)[0], 0);
}

TEST_F(PunctualLights, aLampFallsOffWithTheSquareOfItsDistance) {
    const GltfSurface surface{{0.8, 0.8, 0.8}, 0, 1};
    const auto small = litWall(materialOf(surface));
    small->world.lights = {lampBefore(*small)};
    expectClosedForm(surface, small->world.lights, *small);
    // A lamp ten times as far away and a hundred times as strong gives the same irradiance.
    PlacedLight& lamp = small->world.lights[0];
    lamp.position += fromWall(*small, {0, 0, 9 * 1.2});
    lamp.light.intensity *= 100;
    expectClosedForm(surface, small->world.lights, *small);
}

// A lamp's light ends at its range of 1.3 m. The nearest point of the wall is 1.2 m away, and the corners of the frame
// are beyond the range.
TEST_F(PunctualLights, aLampsRangeEndsItsLight) {
    const GltfSurface surface{{0.8, 0.8, 0.8}, 0, 1};
    const auto small = litWall(materialOf(surface));
    PlacedLight lamp = lampBefore(*small);
    lamp.light.range = 1.3f;
    small->world.lights = {lamp};
    expectClosedForm(surface, small->world.lights, *small);
    const Image image = wallImage(*small);
    int inside = 0, beyond = 0;
    for (const WallPoint& point : wallPoints(*small)) {
        const bool reached = glm::distance(point.position, lamp.position) < 1.3;
        ++(reached ? inside : beyond);
        if (!reached) {
            ASSERT_EQ(image.at(point.x, point.y)[0], 0);
        }
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(beyond, 50);
}

TEST_F(PunctualLights, aSpotFadesFromItsInnerToItsOuterCone) {
    const GltfSurface surface{{0.8, 0.6, 0.4}, 0.5, 0.6};
    const auto small = litWall(materialOf(surface));
    PlacedLight spot = lampBefore(*small);
    spot.light.type = LightType::spot;
    spot.light.innerConeAngle = 0.15f;
    spot.light.outerConeAngle = 0.4f;
    spot.direction = glm::normalize(fromWall(*small, {-0.2, 0.1, -1}));
    small->world.lights = {spot};
    expectClosedForm(surface, small->world.lights, *small);
    int full = 0, fading = 0, dark = 0;
    for (const WallPoint& point : wallPoints(*small)) {
        const double angle = std::acos(glm::dot(spot.direction, glm::normalize(point.position - spot.position)));
        ++(angle < 0.15 ? full : angle < 0.4 ? fading : dark);
    }
    EXPECT_GT(full, 10);
    EXPECT_GT(fading, 50);
    EXPECT_GT(dark, 50);
}

// The radiance of several lights adds up. A few lights are constants of the shader; many lights are read from a buffer.
TEST_F(PunctualLights, severalAddUp) {
    const GltfSurface surface{{0.8, 0.6, 0.4}, 0.2, 0.5};
    const auto small = litWall(materialOf(surface));
    PlacedLight spot = lampBefore(*small);
    spot.light.type = LightType::spot;
    spot.light.outerConeAngle = 0.6f;
    spot.direction = glm::normalize(fromWall(*small, {0, 0.3, -1}));
    small->world.lights = {sunFrom(fromWall(*small, {1, -1, -1}), 1), lampBefore(*small), spot};
    expectClosedForm(surface, small->world.lights, *small);
    for (int i = 0; i < 4; ++i) {
        PlacedLight lamp = lampBefore(*small);
        lamp.position += fromWall(*small, {0.3 * i - 0.6, 0.2 * i, 0.1 * i});
        small->world.lights.push_back(lamp);
    }
    expectClosedForm(surface, small->world.lights, *small);
    for (PlacedLight& placed : small->world.lights) placed.light.intensity /= 50;
    const std::vector<PlacedLight> some = small->world.lights;
    for (std::size_t i = some.size(); i < maxLights; ++i) small->world.lights.push_back(some[i % some.size()]);
    expectClosedForm(surface, small->world.lights, *small);
}

}  // namespace
}  // namespace defocus::engine
