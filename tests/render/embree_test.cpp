// Tests the ray tracer against closed forms (no GPU, no code of the rasterizer). Other tests use it as their reference.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "embree/lens_rays.h"
#include "likeness.h"
#include "render/methods.h"
#include "render/traced.h"

namespace defocus::engine {
namespace {

Rectangle quadAt(const View& view, double depth) {
    return {view.width / 2.0 - 1.5, view.height / 2.0 - 1.5, view.width / 2.0 + 1.5, view.height / 2.0 + 1.5, depth};
}

TEST(EmbreePinhole, RectangleCoversItsPixelsAndNoOthers) {
    View view = bokehView(64, 48);
    view.lens.dofEnabled = false;
    const Image image = traced(rectangleScene(view, {{10, 5, 31, 20, 3}}, glm::vec3(0.25f, 0.5f, 2)), view, 16);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool inside = x >= 10 && x < 31 && y >= 5 && y < 20;
            ASSERT_EQ(image.at(x, y)[2], inside ? 2.0f : 0.0f) << "pixel " << x << ", " << y;
            ASSERT_EQ(image.at(x, y)[3], 1.0f);
        }
    }
}

TEST(EmbreePinhole, EdgeThroughAPixelGivesItsCoveredShare) {
    View view = bokehView(64, 48);
    view.lens.dofEnabled = false;
    const Image image = traced(rectangleScene(view, {{10.25, 5, 31, 20.5, 3}}, glm::vec3(1)), view, 256);
    // A (0, 2)-net of 256 points has 192 points in three quarters of the pixel and 128 in half of it.
    EXPECT_NEAR(*image.at(10, 10), 0.75, 1.0 / 256);
    EXPECT_NEAR(*image.at(20, 20), 0.5, 1.0 / 256);
    EXPECT_NEAR(*image.at(10, 20), 0.375, 2.0 / 256);
}

TEST(EmbreePinhole, EveryWayToCloseTheApertureGivesTheSameImage) {
    View closed = bokehView(64, 48);
    closed.lens.dofEnabled = false;
    View unscaled = bokehView(64, 48);
    unscaled.lens.blurScale = 0;
    const Scene scene = rectangleScene(closed, {{10.3, 5.1, 31.7, 20.9, 3}}, glm::vec3(1));
    EXPECT_EQ(traced(scene, closed, 8).pixels, traced(scene, unscaled, 8).pixels);
}

TEST(EmbreeFocus, PlaneOfFocusIsUnchangedByTheAperture) {
    const View open = bokehView(64, 48);
    View closed = open;
    closed.lens.dofEnabled = false;
    const Scene scene = rectangleScene(open, {{10.3, 5.1, 31.7, 20.9, open.lens.focusDistance}}, glm::vec3(1));
    // Images with open and closed aperture use the same pixel samples. A ray's hit may differ only where float rounding
    // moves it across an edge of the surface.
    EXPECT_LE(largestDifference(traced(scene, open, 64), traced(scene, closed, 64)), 1.0 / 64);
}

TEST(EmbreeFocus, InfinityKeepsTheSkySharpAndBlursAQuadByTheFormula) {
    View view = bokehView(96, 96);
    view.lens.focusDistance = std::numeric_limits<double>::infinity();
    view.lens.fStop = 0.4;
    const double depth = 1;
    const Moments moments = momentsOf(traced(rectangleScene(view, {quadAt(view, depth)}, glm::vec3(1)), view, 1024));
    EXPECT_NEAR(radiusBySecondMoment(moments, 0, 3), blurDiameter(view, depth) / 2, 0.1);

    Environment sky;
    sky.zenith = glm::vec3(1);
    View closed = view;
    closed.lens.dofEnabled = false;
    EXPECT_EQ(largestDifference(traced(Scene{}, view, 16, sky), traced(Scene{}, closed, 16, sky)), 0);
}

TEST(EmbreeFocus, BreathingNarrowsTheViewAsAThinLensDoes) {
    View view = bokehView(64, 48);
    view.lens.focusDistance = 1;
    const double still = lensCamera(view).tanHalfHorizontal;
    view.lens.focusBreathing = true;
    // With focus breathing, the distance from lens to sensor is 1/(1/f − 1/s) instead of the focal length f. With f =
    // 0.05 m and the focus distance s = 1 m, it is 1/(1/0.05 − 1) = 0.0526 m.
    EXPECT_NEAR(lensCamera(view).tanHalfHorizontal, still * 0.05 * (1 / 0.05 - 1), 1e-12);
}

// With a foreground limit on the circle of confusion C (Munkberg, Toth and Akenine-Möller 2012), a ray passes at depth
// z through X(z) = z·d − tan(θx/2)·C(z)·(u, v). d is the direction from the lens centre through the pixel, θx the
// horizontal field of view and (u, v) the lens point.
TEST(EmbreeLimitedForeground, raysAreThoseOfTheLimitedBlur) {
    for (const double focus : {1.5, 4.0, std::numeric_limits<double>::infinity()}) {
        View view = bokehView(200, 120);
        view.lens.focusDistance = focus;
        view.lens.foregroundLimit = 7;
        const LensCamera camera = lensCamera(view);
        const double tangent = 0.5 * view.lens.horizontalAperture / view.lens.focalLength;
        const double radius = 0.5 * view.lens.focalLength / (1000 * view.lens.fStop);
        for (const glm::dvec2 point : {glm::dvec2(0), glm::dvec2(0.6, -0.8), glm::dvec2(-0.3, 0.1)}) {
            const glm::dvec2 image(0.7, -0.4);
            const LensRay eye = eyeRay(camera, image, point);
            const LensRay behind = refractedRay(camera, image, eye);
            const glm::dvec2 axis(image.x * tangent, image.y * tangent * 120 / 200);
            for (const double z : {0.01, 0.1, 0.5, 0.9, 1.2, 3.0, 20.0}) {
                // blur in px; positive in front of the focal plane
                const double plain = radius / tangent * (1 / z - 1 / focus) * 200;
                const double shift = tangent * std::min(plain, 7.0) / 200;  // lateral offset per m of depth
                const LensRay& ray = z < camera.lensDepth ? eye : behind;
                const double along = z + ray.origin.z;
                const glm::dvec2 place(ray.origin.x + along * ray.direction.x, ray.origin.y + along * ray.direction.y);
                EXPECT_LT(glm::length(place / z - (axis + shift * point)), 1e-6) << focus << " m, at " << z << " m";
            }
        }
    }
}

TEST(EmbreeLimitedForeground, otherControlsAreRefused) {
    View view = bokehView(16, 12);
    view.lens.foregroundLimit = 0;
    EXPECT_THROW((void)traced(Scene{}, view, 1), Error);
    view.lens.foregroundLimit = 3;
    EXPECT_NO_THROW((void)traced(Scene{}, view, 1));
    view.lens.backgroundLimit = 3;
    EXPECT_THROW((void)traced(Scene{}, view, 1), Error);
}

struct BokehCase {
    const char* name;
    double depth;
    int bladeCount;
};

class EmbreeBokeh : public testing::TestWithParam<BokehCase> {};

TEST_P(EmbreeBokeh, SmallQuadHasTheRadiusAndTheEnergyOfTheFormula) {
    View view = bokehView(48, 48);
    view.lens.bladeCount = GetParam().bladeCount;
    view.lens.bladeRotation = 0.3;
    const Scene scene = rectangleScene(view, {quadAt(view, GetParam().depth)}, glm::vec3(100));
    const Moments moments = momentsOf(traced(scene, view, 4096));
    EXPECT_NEAR(radiusBySecondMoment(moments, view.lens.bladeCount, 3), blurDiameter(view, GetParam().depth) / 2, 0.1);
    EXPECT_NEAR(moments.energy, 900, 900 * 0.005);
    EXPECT_NEAR(moments.mean.x, 24, 0.1);
    EXPECT_NEAR(moments.mean.y, 24, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EmbreeBokeh,
                         testing::Values(BokehCase{"DiskInFront", 1.2, 0}, BokehCase{"DiskBehind", 6, 0},
                                         BokehCase{"HexagonInFront", 1.2, 6}, BokehCase{"HexagonBehind", 6, 6}),
                         [](const auto& test) { return test.param.name; });

TEST(EmbreeBokehShape, TriangleStandsUprightBehindFocusAndUpsideDownInFront) {
    View view = bokehView(64, 64);
    view.lens.bladeCount = 3;
    view.lens.bladeRotation = std::numbers::pi / 2;  // rotates the polygon so that its first corner points up
    // Behind the focal plane, the image of a point moves with the lens point, so the triangular bokeh has a corner at
    // the top. In front of the focal plane, the corner is at the bottom.
    for (const double depth : {1.2, 6.0}) {
        const Image image = traced(rectangleScene(view, {quadAt(view, depth)}, glm::vec3(100)), view, 1024);
        const double radius = blurDiameter(view, depth) / 2;
        // distance in px from the bokeh's centre to a pixel inside the bokeh, in the direction of a corner
        const int lit = static_cast<int>(0.8 * radius);
        // distance in px from the bokeh's centre to a pixel just beyond the flat side
        const int dark = static_cast<int>(0.5 * radius + 1.5) + 1;
        const bool upright = depth > view.lens.focusDistance;
        EXPECT_GT(*image.at(32, upright ? 31 - lit : 32 + lit), 0.5f * *image.at(32, 32));
        EXPECT_EQ(*image.at(32, upright ? 32 + dark : 31 - dark), 0);
    }
}

TEST(EmbreeBokehShape, AnamorphicRatioMakesTallOvals) {
    View view = bokehView(64, 64);
    view.lens.anamorphicRatio = 2;
    const Moments moments = momentsOf(traced(rectangleScene(view, {quadAt(view, 6)}, glm::vec3(100)), view, 1024));
    const double radius = blurDiameter(view, 6) / 2;
    EXPECT_NEAR(2 * std::sqrt(moments.variance.y - 10.0 / 12), radius, 0.1);
    EXPECT_NEAR(2 * std::sqrt(moments.variance.x - 10.0 / 12), radius / 2, 0.1);
}

// Returns the fraction of a disk of radius 1 that lies left of the chord at `x`.
double diskShareLeftOf(double x) {
    const double inside = std::clamp(x, -1.0, 1.0);
    return 0.5 + (inside * std::sqrt(1 - inside * inside) + std::asin(inside)) / std::numbers::pi;
}

TEST(EmbreeHalfPlane, EdgeIsBlurredByTheProfileOfADisk) {
    const View view = bokehView(128, 32);
    const double depth = 6;
    const double radius = blurDiameter(view, depth) / 2;
    const double edge = 64.3;
    const Image image = traced(rectangleScene(view, {{edge, -200, 500, 232, depth}}, glm::vec3(1)), view, 256);
    for (int x = 0; x < view.width; ++x) {
        double mean = 0;
        for (int y = 0; y < view.height; ++y) mean += *image.at(x, y) / static_cast<double>(view.height);
        double expected = 0;
        for (int i = 0; i < 64; ++i) expected += diskShareLeftOf((x + (i + 0.5) / 64 - edge) / radius) / 64;
        ASSERT_NEAR(mean, expected, 0.005) << "column " << x;
    }
}

TEST(EmbreeCulling, SingleSidedSurfacesAreSeenFromTheirFrontOnly) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    Scene scene = rectangleScene(view, {{0, 0, 32, 32, 3}}, glm::vec3(1));
    EXPECT_EQ(*traced(scene, view, 1).at(16, 16), 1);
    std::swap(scene.meshes[0].primitives[0].indices[1],
              scene.meshes[0].primitives[0].indices[2]);  // reverses the winding of the lower right triangle
    EXPECT_EQ(*traced(scene, view, 1).at(24, 20), 0);
    EXPECT_EQ(*traced(scene, view, 1).at(7, 12), 1);  // the upper left triangle is still visible
    // A mirrored object shows the same side, although its winding is reversed.
    scene.nodes[0].matrix = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
    EXPECT_EQ(*traced(scene, view, 1).at(7, 20), 0);
    EXPECT_EQ(*traced(scene, view, 1).at(24, 12), 1);
    scene.materials[0].doubleSided = true;
    EXPECT_EQ(*traced(scene, view, 1).at(7, 20), 1);
}

TEST(EmbreeCulling, NothingNearerThanTheNearPlaneIsSeen) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    view.nearPlane = 1;
    const Scene scene = rectangleScene(view, {{0, 0, 16, 32, 0.99}, {16, 0, 32, 32, 1.01}}, glm::vec3(1));
    const Image image = traced(scene, view, 1);
    EXPECT_EQ(*image.at(8, 16), 0);
    EXPECT_EQ(*image.at(24, 16), 1);
}

TEST(EmbreeBackground, GradientFollowsTheDirectionOfTheRay) {
    View view = bokehView(64, 48);
    view.lens.dofEnabled = false;
    const double pitch = 0.4;  // angle in rad by which the camera looks up
    view.worldFromCamera = glm::rotate(glm::dmat4(1), pitch, glm::dvec3(1, 0, 0));
    Environment sky;
    sky.zenith = glm::vec3(1, 0, 0);
    sky.horizon = glm::vec3(0, 1, 0);
    sky.nadir = glm::vec3(0, 0, 1);
    const Image image = traced(Scene{}, view, 64, sky);
    for (const int row : {0, 23, 47}) {
        const double slope = (24 - row - 0.5) * 2 * tanHalf(view) / 64;
        // y component of the unit direction of the row's ray in the middle column
        const double height = std::sin(pitch + std::atan(slope));
        EXPECT_NEAR(image.at(32, row)[0], std::max(0.0, height), 2e-3);
        EXPECT_NEAR(image.at(32, row)[1], 1 - std::abs(height), 2e-3);
        EXPECT_NEAR(image.at(32, row)[2], std::max(0.0, -height), 2e-3);
    }
}

TEST(EmbreeBackground, NoneIsTransparentAndKeepsCoverageInAlpha) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    Environment none;
    none.type = EnvironmentType::none;
    const Image image = traced(rectangleScene(view, {{8.5, 0, 32, 32, 3}}, glm::vec3(0.5f)), view, 256, none);
    EXPECT_EQ(image.at(2, 16)[3], 0);
    EXPECT_NEAR(image.at(8, 16)[3], 0.5, 1.0 / 256);
    EXPECT_NEAR(image.at(8, 16)[0], 0.25, 1.0 / 256);  // premultiplied colour
    EXPECT_EQ(image.at(20, 16)[3], 1);
}

TEST(EmbreeConstantScene, StaysConstantAtAnySampleCount) {
    const View view = bokehView(40, 24);
    Environment grey;
    grey.type = EnvironmentType::uniform;
    grey.zenith = glm::vec3(0.3f);
    const Scene scene = rectangleScene(view, {{5, 5, 20, 20, 1}, {10, 3, 30, 22, 5}}, glm::vec3(0.3f));
    for (const std::uint32_t samples : {1u, 7u, 33u}) {
        for (const EmbreeSampling sampling : {EmbreeSampling::perPixel, EmbreeSampling::shared}) {
            const Image image = traced(scene, view, samples, grey, sampling);
            for (std::size_t i = 0; i < image.pixels.size(); i += 4) ASSERT_FLOAT_EQ(image.pixels[i], 0.3f);
        }
    }
}

TEST(EmbreeSharing, SharedLensSamplesConvergeToTheSameImage) {
    const View view = bokehView(64, 64);
    const Scene scene = rectangleScene(view, {{20, 20, 44, 44, 6}}, glm::vec3(1));
    const Image own = traced(scene, view, 1024);
    const Image shared = traced(scene, view, 1024, blackBackground(), EmbreeSampling::shared);
    EXPECT_LE(largestDifference(own, shared), 0.03);
    EXPECT_GT(largestDifference(own, shared), 0);
}

TEST(EmbreePlanned, SamplePointsAreThoseOfThePlan) {
    View view = bokehView(64, 64);
    const double radius = blurDiameter(view, 6) / 2;
    const Scene scene = rectangleScene(view, {{30, 20, 33, 23, 6}}, glm::vec3(1));
    const World world = flatWorld(scene, blackBackground());
    FramePlan plan = planOf(view, 1);
    // If the lens point moves right and up, objects behind the focal plane move right and up in the image. If the
    // sample's position in the pixel moves right and up, the image moves left and down.
    LensSample sample;
    sample.lens = glm::vec2(4 / radius, 6 / radius);
    sample.pixel = glm::vec2(0.4f, -0.4f);
    plan.samples = {sample};
    const Moments moments = momentsOf(imageOf(*makeEmbreeRenderer(world, EmbreeSampling::planned), plan));
    EXPECT_DOUBLE_EQ(moments.mean.x, 31.5 + 4);
    EXPECT_DOUBLE_EQ(moments.mean.y, 21.5 - 6);
    sample.pixel = glm::vec2(0.4f, 0.4f);
    // This lens point moves the image by 4.2 px to the right and 6.2 px up. The pixel offset is subtracted, and the
    // difference is rounded. With an offset of 0.4 px, the image still moves by 4 and 6 px (3.8 and 5.8, rounded). With
    // an offset of −0.4 px, it moves by 5 and 7 px (4.6 and 6.6, rounded).
    sample.lens = glm::vec2(4.2 / radius, 6.2 / radius);
    plan.samples = {sample};
    const Moments further = momentsOf(imageOf(*makeEmbreeRenderer(world, EmbreeSampling::planned), plan));
    EXPECT_DOUBLE_EQ(further.mean.x, 31.5 + 4);
    EXPECT_DOUBLE_EQ(further.mean.y, 21.5 - 6);
    sample.pixel = glm::vec2(-0.4f, -0.4f);
    plan.samples = {sample};
    const Moments across = momentsOf(imageOf(*makeEmbreeRenderer(world, EmbreeSampling::planned), plan));
    EXPECT_DOUBLE_EQ(across.mean.x, 31.5 + 5);
    EXPECT_DOUBLE_EQ(across.mean.y, 21.5 - 7);
}

TEST(EmbreeLambert, RadianceIsAlbedoTimesIlluminanceOverPi) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    Scene scene = rectangleScene(view, {{0, 0, 32, 32, 3}}, glm::vec3(0.5f));
    scene.materials[0].unlit = false;
    scene.materials[0].metallicFactor = 0;
    World world = flatWorld(scene, blackBackground());
    PlacedLight sun;
    sun.light.intensity = 4;
    // direction of the light, 60° from the surface's normal
    sun.direction = glm::normalize(glm::dvec3(std::sqrt(3.0), 0, -1));
    world.lights.push_back(sun);
    const Image image = imageOf(*makeEmbreeRenderer(world), planOf(view, 1));
    EXPECT_NEAR(*image.at(16, 16), 0.5 * 4 * 0.5 / std::numbers::pi, 1e-6);
}

TEST(EmbreeTexture, TexelsLieWhereGltfPutsThem) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    Scene scene = rectangleScene(view, {{0, 0, 32, 32, 3}}, glm::vec3(1));
    scene.meshes[0].vertices.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};  // v = 0 is the texture's top row
    scene.images.push_back({2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 188, 188, 188, 255}});
    Texture texture;
    texture.image = 0;
    texture.magnification = Filter::nearest;
    scene.textures.push_back(texture);
    scene.materials[0].baseColor.texture = 0;
    const Image image = traced(scene, view, 1);
    EXPECT_EQ(image.at(8, 8)[0], 1);
    EXPECT_EQ(image.at(24, 8)[1], 1);
    EXPECT_EQ(image.at(8, 24)[2], 1);
    EXPECT_NEAR(image.at(24, 24)[0], 0.5029, 1e-3);  // linear value of the sRGB code 188
    // Filtering is bilinear between decoded texels. The tested pixel lies about a quarter of the way from the centre of
    // the red texel to the centre of the green texel.
    scene.textures[0].magnification = Filter::linear;
    const Image smooth = traced(scene, view, 256);
    EXPECT_NEAR(smooth.at(12, 8)[0], 1 - (12.5 / 32 - 0.25) * 2, 0.05);
}

TEST(EmbreeSampling, EveryPrefixOfPowersOfTwoIsStratified) {
    for (const SamplePair pair : {SamplePair::lens, SamplePair::pixel}) {
        std::array<int, 16> columns{};
        std::array<int, 16> cells{};
        for (std::uint32_t i = 0; i < 16; ++i) {
            const glm::dvec2 point = scrambledPoint(i, 77, pair, 3);
            ++columns[static_cast<std::size_t>(point.x * 16)];
            ++cells[static_cast<std::size_t>(point.x * 4) * 4 + static_cast<std::size_t>(point.y * 4)];
        }
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(columns[i], 1);
            EXPECT_EQ(cells[i], 1);
        }
    }
}

TEST(EmbreeMethods, AreInTheTableOnceRegistered) {
    registerEmbree();
    registerEmbree();
    const View view = bokehView(8, 8);
    const Scene scene = rectangleScene(view, {{0, 0, 8, 8, 2}}, glm::vec3(1));
    const World world = flatWorld(scene, blackBackground());
    for (const char* name : {"embree", "embree-shared", "embree-planned"}) {
        FramePlan plan = planOf(view, 2);
        plan.samples.resize(2);
        EXPECT_FALSE(methodNamed(name).needsGl);
        EXPECT_FALSE(methodNamed(name).shadesAsLit);
        EXPECT_FALSE(methodNamed(name).drawsMotion);
        EXPECT_EQ(*imageOf(*methodNamed(name).make(world, {}), plan).at(4, 4), 1) << name;
        EXPECT_EQ(std::count_if(methods().begin(), methods().end(), [&](const Method& m) { return m.name == name; }),
                  1);
    }
}

TEST(EmbreeBadInput, EnvironmentMapIsAClearError) {
    Environment map;
    map.type = EnvironmentType::map;
    EXPECT_THROW(traced(Scene{}, bokehView(8, 8), 1, map), Error);
}

}  // namespace
}  // namespace defocus::engine
