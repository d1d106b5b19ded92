#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/error.h"
#include "image/metrics.h"
#include "likeness.h"
#include "render/accumulation/accumulated.h"
#include "render/accumulation/accumulation.h"
#include "render/aov/aov.h"

namespace defocus::engine {
namespace {

// Returns a green square of half width `halfSize` at distance `depth`, both in m, in front of a uniform red background.
std::unique_ptr<SmallWorld> wall(double depth, double halfSize) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({0.1f, 0.7f, 1.0f / 3, 1}));
    small->scene.meshes.push_back(quad(0));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -depth)), glm::dvec3(halfSize)));
    small->world.environment = {EnvironmentType::uniform, {0.8f, 0.1f, 0.1f}, {}, {}, nullptr, 1};
    small->view.width = 96;
    small->view.height = 64;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    finish(*small);
    return small;
}

TEST_F(Accumulation, geometryShaderLayersGiveTheSameImage) {
    const auto small = fiveSpheres();
    const RendererOptions options{.geometryShaderLayers = true};
    const Image expected = rendered(*small, settingsFor(16));
    const Image image = rendered(*small, settingsFor(16), options);
    EXPECT_LT(largestDifference(expected, image),
              // tolerance for different rounding of vertex positions; no triangle may gain or lose a pixel
              1e-3);
}

TEST_F(Accumulation, keepingEverythingGivesTheSameImage) {
    const auto small = fiveSpheres();
    RenderSettings everything = settingsFor(32);
    everything.keepAll = true;
    EXPECT_TRUE(sameBits(rendered(*small, settingsFor(32)), rendered(*small, everything)));
}

TEST_F(Accumulation, leavingOutTheLensChangesLessThanHalfAPixelOfBlurMay) {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 120;
    RenderSettings everything = settingsFor(64, LodMode::off);
    everything.keepAll = true;
    ASSERT_FALSE(planFrame(small->world, small->view, settingsFor(64)).usesLens);
    const Difference difference =
        compareImages(rendered(*small, everything), rendered(*small, settingsFor(64, LodMode::off)));
    EXPECT_GT(difference.psnr, 36);
    EXPECT_LT(std::abs(difference.mae), 0.004);
}

TEST_F(Accumulation, apertureZeroIsThePinhole) {
    const auto small = fiveSpheres();
    RenderSettings settings = settingsFor(16, LodMode::off);
    settings.keepAll = true;
    small->view.lens.dofEnabled = false;
    const Image pinhole = rendered(*small, settings);
    small->view.lens.dofEnabled = true;
    small->view.lens.blurScale = 0;
    EXPECT_TRUE(sameBits(pinhole, rendered(*small, settings)));
    small->view.lens.blurScale = 1e-9;
    EXPECT_LT(largestDifference(pinhole, rendered(*small, settings)), 1e-3);
}

TEST_F(Accumulation, focusPlaneIsUnchangedByTheAperture) {
    const auto small = wall(2, 0.4);  // the square is in focus, so its edges must stay sharp
    RenderSettings settings = settingsFor(64);
    settings.keepAll = true;  // draws all lens samples; without blur, the default is a pinhole image
    const Image wide = rendered(*small, settings);
    small->view.lens.dofEnabled = false;
    EXPECT_LT(largestDifference(wide, rendered(*small, settings)), 1e-3);
}

TEST_F(Accumulation, blurredEdgeSpreadsOverTheCircleOfConfusion) {
    const auto small = wall(1, 0.2);
    const double c = 0.05 * 0.5 * 96 / 0.72;  // diameter of the blur, px
    const Image image = rendered(*small, settingsFor(512));
    // The image extends 0.36 m and the square 0.2 m to each side of the image's centre at 48 px. In the middle row, the
    // square's left edge thus lies at x = 48 − 0.2/0.36·48 px. It is blurred over ± c/2.
    const double edge = 48 - 0.2 / 0.36 * 48;
    for (int x = 0; x < 48; ++x) {
        const double green = image.at(x, 32)[1];
        // Profile of a half-plane under a uniform disk of radius r, at the distance d from the edge: 1/2 + (asin(d/r) +
        // d/r·√(1 − (d/r)²))/π.
        const double d = std::clamp((x + 0.5 - edge) / (c / 2), -1.0, 1.0);
        const double covered = 0.5 + (std::asin(d) + d * std::sqrt(1 - d * d)) / std::numbers::pi;
        EXPECT_NEAR(green, 0.1 + 0.6 * covered, 0.04) << x;
    }
}

TEST_F(Accumulation, constantSceneStaysConstant) {
    const auto small = wall(1, 4);
    for (const std::uint32_t n : {1u, 2u, 3u, 7u, 64u, 65u, 200u}) {
        const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
        const Image image = rendered(*small, settingsFor(n), exact);
        const glm::vec3 expected(0.1f, 0.7f, 1.0f / 3);
        for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
            for (glm::length_t c = 0; c < 3; ++c)
                ASSERT_NEAR(image.pixels[i * 4 + static_cast<std::size_t>(c)], expected[c], 1e-6 * expected[c]) << n;
    }
}

TEST_F(Accumulation, halfFloatLayersErrNoMoreThanStated) {
    const auto small = wall(1, 4);
    const RendererOptions options{.layerFormat = LayerFormat::rgba16f};
    const Image image = rendered(*small, settingsFor(64), options);
    const double expected[3] = {0.1, 0.7, 1.0 / 3};
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(image.at(48, 32)[c], expected[c], 0x1p-11 * expected[c]);
}

TEST_F(Accumulation, transparentBackgroundIsPremultipliedCoverage) {
    const auto small = wall(1, 0.2);
    const Image over = rendered(*small, settingsFor(64));
    small->world.environment = {EnvironmentType::none, {}, {}, {}, nullptr, 1};
    const Image alone = rendered(*small, settingsFor(64));
    EXPECT_EQ(alone.at(0, 0)[3], 0);
    EXPECT_NEAR(alone.at(48, 32)[3], 1, 1e-6);
    const glm::vec3 background(0.8f, 0.1f, 0.1f);
    for (int y = 0; y < over.height; ++y)
        for (int x = 0; x < over.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(over.at(x, y)[c], alone.at(x, y)[c] + (1 - alone.at(x, y)[3]) * background[c], 1e-3);
}

TEST_F(Accumulation, invisibleEnvironmentStillLights) {
    const auto small = fiveSpheres();
    const Image over = rendered(*small, settingsFor(16));
    small->world.environment.visible = false;
    const Image alone = rendered(*small, settingsFor(16));
    EXPECT_EQ(alone.at(0, 0)[3], 0);
    int covered = 0;
    for (int y = 0; y < over.height; ++y)
        for (int x = 0; x < over.width; ++x) {
            if (alone.at(x, y)[3] < 1) continue;
            ++covered;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(alone.at(x, y)[c], over.at(x, y)[c], 1e-4);
        }
    EXPECT_GT(covered, 100);
}

TEST_F(Accumulation, nearestRowIsTheTop) {
    const auto small = wall(2, 0.1);
    small->world.pose.objects[0].worldFromObject =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0.3, -2)), glm::dvec3(0.1));
    const Image image = rendered(*small, settingsFor(4));
    const int column = static_cast<int>(48 + 0.3 / 0.72 * 48);
    EXPECT_GT(image.at(column, 32 - 20)[1], 0.5) << "up and right of the middle";
    EXPECT_LT(image.at(column, 32 + 20)[1], 0.5);
}

TEST_F(Accumulation, blendedSurfacesAreDrawnBackToFront) {
    auto small = std::make_unique<SmallWorld>();
    for (const glm::vec4& color : {glm::vec4(1, 0, 0, 0.5f), glm::vec4(0, 1, 0, 0.5f), glm::vec4(0, 0, 1, 1)}) {
        Material material = unlitMaterial(color);
        material.alphaMode = color.a < 1 ? AlphaMode::blend : AlphaMode::opaque;
        small->scene.materials.push_back(material);
        small->scene.meshes.push_back(quad(static_cast<int>(small->scene.materials.size()) - 1));
    }
    const auto at = [](double z) {
        return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -z)), glm::dvec3(9));
    };
    place(*small, 0, at(2));  // the red, green and blue quads are at depths of 2, 3 and 4 m
    place(*small, 2, at(4));
    place(*small, 1, at(3));
    small->world.environment.type = EnvironmentType::uniform;
    small->view.width = small->view.height = 16;
    small->view.lens.dofEnabled = false;
    finish(*small);
    const Image image = rendered(*small, settingsFor(4));
    EXPECT_NEAR(image.at(8, 8)[0], 0.5, 1e-3);
    EXPECT_NEAR(image.at(8, 8)[1], 0.25, 1e-3);
    EXPECT_NEAR(image.at(8, 8)[2], 0.25, 1e-3);
}

// Through a pinhole, each pixel shows the gradient sky's radiance L(d) for the pixel's direction d. A lens would blur
// the sky unless it is focused at infinity.
TEST_F(Accumulation, gradientSkyIsItsFormula) {
    SmallWorld small;
    small.world.environment = {
        EnvironmentType::gradient, {0.2f, 0.4f, 0.9f}, {0.6f, 0.6f, 0.5f}, {0.1f, 0.2f, 0.1f}, nullptr, 1};
    small.view.width = 64;
    small.view.height = 48;
    small.view.lens.dofEnabled = false;
    small.view.worldFromCamera = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(1, 0, 0));
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const Image image = rendered(small, settingsFor(1), options);
    const double tanX = 0.36;
    for (int y = 0; y < 48; y += 5)
        for (int x = 0; x < 64; x += 7) {
            const glm::dvec3 view((2 * (x + 0.5) / 64 - 1) * tanX, (1 - 2 * (y + 0.5) / 48) * tanX * 0.75, -1);
            const double height = glm::normalize(glm::dmat3(small.view.worldFromCamera) * view).y;
            const glm::dvec3 pole = height > 0 ? glm::dvec3(0.2, 0.4, 0.9) : glm::dvec3(0.1, 0.2, 0.1);
            const glm::dvec3 expected = glm::mix(glm::dvec3(0.6, 0.6, 0.5), pole, std::abs(height));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(x, y)[c], expected[c], 1e-5) << x << ' ' << y;
        }
}

TEST_F(Accumulation, environmentMapOfOneColourIsTheUniformEnvironment) {
    const auto small = fiveSpheres();
    auto map = std::make_shared<Image>(32, 16, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = i % 3 == 0 ? 0.25f : 0.5f;
    small->world.environment = {EnvironmentType::map, {}, {}, {}, map, 1};
    const Image mapped = rendered(*small, settingsFor(8));
    small->world.environment = {EnvironmentType::uniform, {0.25f, 0.5f, 0.5f}, {}, {}, nullptr, 1};
    EXPECT_LT(largestDifference(mapped, rendered(*small, settingsFor(8))), 5e-3);
}

// Adds a lamp and a spotlight to the world's lights.
void addLocalLights(SmallWorld& small) {
    PlacedLight lamp;
    lamp.light.type = LightType::point;
    lamp.light.color = {1, 0.6f, 0.3f};
    lamp.light.intensity = 6;
    lamp.light.range = 8;
    lamp.position = {-1, 1.5, -2};
    PlacedLight spot = lamp;
    spot.light.type = LightType::spot;
    spot.light.color = {0.3f, 0.6f, 1};
    spot.position = {2, 2, -1};
    spot.direction = glm::normalize(glm::dvec3(-1, -1, -1));
    small.world.lights.insert(small.world.lights.end(), {lamp, spot});
}

// Lights give the same image whether they are constants or uniforms of the shaders. A few lights are compiled into the
// shaders as constants. Additional dark lights exceed the limit, so that all lights become uniforms.
TEST_F(Accumulation, constantLightsLightAsUniformOnes) {
    const auto small = fiveSpheres();
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const Image sunOnly = rendered(*small, settingsFor(4), options);
    addLocalLights(*small);
    const Image constant = rendered(*small, settingsFor(4), options);
    EXPECT_GT(largestDifference(sunOnly, constant), 0.1);
    PlacedLight dark;
    dark.light.intensity = 0;
    small->world.lights.resize(small->world.lights.size() + 3, dark);
    EXPECT_LT(largestDifference(constant, rendered(*small, settingsFor(4), options)), 1e-4);
}

// A light of infinite intensity gives finite pixels, although infinity cannot be a constant of a shader.
TEST_F(Accumulation, infiniteLightIsDrawn) {
    const auto small = wall(1, 4);
    small->scene.materials[0] = Material{};
    PlacedLight sun;
    sun.light.intensity = std::numeric_limits<float>::infinity();
    small->world.lights = {sun};
    const Image image = rendered(*small, settingsFor(1));
    for (const float value : image.pixels) EXPECT_TRUE(std::isfinite(value));
}

// The image stays the same when camera, objects and lights move together and rotate about the vertical axis, although
// shading uses world coordinates.
TEST_F(Accumulation, turningTheWholeWorldChangesNothing) {
    const auto small = fiveSpheres();
    addLocalLights(*small);
    const Image before = rendered(*small, settingsFor(4));
    const glm::dmat4 turn = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(5, -2, 7)), 1.1, glm::dvec3(0, 1, 0));
    for (Object& object : small->world.pose.objects) object.worldFromObject = turn * object.worldFromObject;
    for (PlacedLight& light : small->world.lights) {
        light.position = glm::dvec3(turn * glm::dvec4(light.position, 1));
        light.direction = glm::dmat3(turn) * light.direction;
    }
    // the images differ, because objects and lights have moved relative to the camera
    EXPECT_LT(compareImages(before, rendered(*small, settingsFor(4))).psnr, 60);
    small->view.worldFromCamera = turn * small->view.worldFromCamera;
    EXPECT_GT(compareImages(before, rendered(*small, settingsFor(4))).psnr, 60);
}

// Interpolated normals that face away from the eye cause no overly bright highlights: shading clamps the cosine between
// the normal and the half vector to [0, 1].
TEST_F(Accumulation, normalsThatLookAwayDoNotGlare) {
    const auto small = wall(1, 4);
    small->scene.materials[0] = Material{};
    small->scene.materials[0].metallicFactor = 0;
    small->scene.materials[0].roughnessFactor = 0.3f;
    small->world.environment = {EnvironmentType::uniform, {0, 0, 0}, {}, {}, nullptr, 1};
    PlacedLight lamp;
    lamp.light.intensity = 1;
    lamp.direction = {0, 0, 1};  // light from behind the wall
    small->world.lights = {lamp};
    for (const float tilt : {-0.9f, -0.5f, -0.1f, -0.01f}) {
        changePyramids(small->world, [&](Pyramid& pyramid) {
            for (glm::vec3& normal : pyramid.levels[0].normals) normal = glm::vec3(std::sqrt(1 - tilt * tilt), 0, tilt);
        });
        EXPECT_LT(rendered(*small, settingsFor(1)).at(48, 32)[0], 1) << tilt;
    }
}

TEST_F(Accumulation, statsCountWhatThePlanSays) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(100));
    const RendererOptions options{.wave = 7};
    const auto renderer = makeAccumulationRenderer(small->world, options);
    drawAllSamples(*renderer, plan);
    EXPECT_EQ(renderer->stats().trianglesDrawn, plan.trianglesDrawn);
    EXPECT_EQ(renderer->stats().samples, 100u);
    renderer->start(plan);
    EXPECT_EQ(renderer->samples(), 0u);
}

TEST_F(Accumulation, aovsAreDepthBlurAndLevel) {
    const auto small = wall(1.5, 0.2);
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(4));
    const AovImages aovs = renderAovs(small->world, plan);
    EXPECT_NEAR(aovs.depth.at(48, 32)[0], 1.5, 1e-5);
    EXPECT_NEAR(aovs.coc.at(48, 32)[0], 0.05 * (1 / 2.0 - 1 / 1.5) * 96 / 0.72, 1e-4);
    EXPECT_NEAR(aovs.level.at(48, 32)[0], plan.objects[0].lambda, 1e-6);
    EXPECT_TRUE(std::isinf(aovs.depth.at(0, 0)[0]));
    EXPECT_NEAR(aovs.coc.at(0, 0)[0], 0.05 / 2 * 96 / 0.72, 1e-4);
    EXPECT_EQ(aovs.level.at(0, 0)[0], -1);
    EXPECT_EQ(levelColourMap(aovs.level).at(0, 0)[0], 0);
}

}  // namespace
}  // namespace defocus::engine
