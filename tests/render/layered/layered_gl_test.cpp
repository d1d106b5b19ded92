// Tests method "layered", which traces lens rays through depth layers, against formulas and against method
// "accumulation".

#include <cmath>
#include <numbers>

#include "bokeh.h"
#include "core/error.h"
#include "image/metrics.h"
#include "render/layered/layered_images.h"

namespace defocus::engine {
namespace {

// An unlit pane that faces the camera and covers `area`, in px from the image's top left corner.
struct Pane {
    Rectangle area;
    glm::vec4 color{1};
};

// Returns panes seen through the wide lens of bokehView(), focused at 2 m.
std::unique_ptr<SmallWorld> panes(const std::vector<Pane>& list, int width = 96, int height = 64) {
    auto small = std::make_unique<SmallWorld>();
    small->view = bokehView(width, height);
    for (const Pane& board : list) {
        const int index = static_cast<int>(small->scene.materials.size());
        small->scene.materials.push_back(unlitMaterial(board.color));
        if (board.color.a < 1) small->scene.materials.back().alphaMode = AlphaMode::blend;
        small->scene.meshes.push_back(rectangleMesh(small->view, board.area, index));
        place(*small, index, glm::dmat4(1));
    }
    small->world.environment = blackBackground();
    finish(*small);
    return small;
}

// Scales the lens's blur so that a point at `depth` has a blur of `pixels` px.
void blurBy(SmallWorld& small, double pixels, double depth) {
    small.view.lens.blurScale *= pixels / blurDiameter(small.view, depth);
}

constexpr double everywhere = 1000;  // position in px far beyond the frame

Pane wallAt(double depth, const glm::vec4& color) {
    return {{-everywhere, -everywhere, everywhere, everywhere, depth}, color};
}

TEST_F(Layered, apertureZeroIsThePinholeImage) {
    const auto small = fiveSpheres();
    small->view.lens.blurScale = 0;
    EXPECT_LT(largestDifference(seenBy(*small, "accumulation", 1), seenBy(*small, "layered", 1)), 2e-3);
    // A uniform sky is the same in all lens samples; the default sky is not, because it varies within a pixel.
    small->world.environment = {EnvironmentType::uniform, glm::vec3(0.4f), {}, {}, nullptr, 1};
    EXPECT_LT(largestDifference(seenBy(*small, "accumulation", 1), seenBy(*small, "layered:pinholes=1", 32)), 2e-3);
}

// An environment map is drawn with a frame plan without objects. This plan must not list blended primitives, because
// they would refer to the missing objects.
TEST_F(Layered, anEnvironmentMapIsSeenThroughBlendedObjects) {
    const auto small = fiveSpheres();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.5f;
    small->view.lens.blurScale = 0;
    auto map = std::make_shared<Image>(16, 8, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = static_cast<float>(i % 48) / 48;
    small->world.environment.type = EnvironmentType::map;
    small->world.environment.map = map;
    EXPECT_GT(compareImages(seenBy(*small, "accumulation", 16), seenBy(*small, "layered", 16)).psnr, 30);
}

TEST_F(Layered, aConstantSceneStaysConstant) {
    const glm::vec4 color(0.125f, 0.75f, 0.375f, 1);
    const auto small = panes({{{10, 8, 40, 60, 1.2}, color},
                              {{30, 20, 70, 50, 2}, color},
                              {{-200, 30, 300, 200, 4}, color},
                              wallAt(9, color)});
    small->world.environment = {EnvironmentType::uniform, glm::vec3(color), {}, {}, nullptr, 1};
    const Image image = seenBy(*small, "layered", 64);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_NEAR(image.pixels[i], color[static_cast<int>(i % 4)], 1e-3) << i;
}

TEST_F(Layered, aPointOfLightBecomesADiskOfTheCircleOfConfusion) {
    constexpr double square = 3;  // side of the bright square, px
    for (const double depth : {1.2, 6.0}) {
        const auto small = panes({{{46.5, 30.5, 49.5, 33.5, depth}, glm::vec4(8, 8, 8, 1)}, wallAt(20, {0, 0, 0, 1})});
        blurBy(*small, 24, depth);
        const Image image = seenBy(*small, "layered");
        const Moments moments = momentsOf(image);
        EXPECT_NEAR(2 * radiusBySecondMoment(moments, 0, square), 24, 0.5) << depth;
        EXPECT_NEAR(moments.energy, 8 * square * square, 0.02 * 8 * square * square) << depth;
    }
}

// In a pinhole image, a bar hides a red stripe of the same width behind it. If the bar is blurred, it hides the middle
// of the stripe only from a strip of the lens. The rest of the lens sees the stripe.
TEST_F(Layered, aBlurredBarShowsWhatItHidesFromThePinhole) {
    constexpr double bar = 8;    // width of the bar, px
    constexpr double blur = 24;  // diameter of the bar's blur, px
    const auto small = panes({{{48 - bar / 2, -everywhere, 48 + bar / 2, everywhere, 1.2}, {0, 0, 1, 1}},
                              {{48 - bar / 2, -everywhere, 48 + bar / 2, everywhere, 2}, {1, 0, 0, 1}},
                              wallAt(2.0001, {0, 1, 0, 1})});
    blurBy(*small, blur, 1.2);
    const double half = bar / blur;  // half width, in lens radii, of the strip of the lens that the bar covers
    const double covered = 2 / std::numbers::pi * (std::asin(half) + half * std::sqrt(1 - half * half));
    const Image image = seenBy(*small, "layered");
    const Image oneLayer = seenBy(*small, "layered:layers=1");
    const float* middle = image.at(48, 32);
    EXPECT_NEAR(middle[2], covered, 0.03);
    EXPECT_NEAR(middle[0], 1 - covered, 0.03);
    EXPECT_LT(middle[1], 0.01);
    EXPECT_LT(oneLayer.at(48, 32)[0], 0.01);  // with one layer, the stripe is never visible
}

TEST_F(Layered, lightFromBeyondTheImageReachesIntoIt) {
    const auto small = panes({{{-6, 20, -2, 44, 1.2}, {1, 1, 1, 1}}, wallAt(2, {0, 0, 0, 1})});
    blurBy(*small, 24, 1.2);
    const Image expected = seenBy(*small, "accumulation");
    ASSERT_GT(expected.at(2, 32)[0], 0.05);
    EXPECT_LT(rootMeanSquare(seenBy(*small, "layered"), expected), 0.004);
}

// With more depth layers, the image approaches that of method "accumulation". Boards at many depths hide each other,
// but the lens sees around them.
TEST_F(Layered, moreLayersComeCloserToTheAccumulation) {
    std::vector<Pane> list;
    for (int i = 0; i < 14; ++i) {
        const double left = 44 - 2 * (i % 3);
        list.push_back({{left, 10, left + 8, 54, 0.7 + 0.08 * i},
                        {i % 2 == 0 ? 0.9f : 0.1f, 0.07f * static_cast<float>(i), i % 3 == 0 ? 0.8f : 0.2f, 1}});
    }
    list.push_back(wallAt(4, {0.5, 0.5, 0.5, 1}));
    const auto small = panes(list);
    blurBy(*small, 40, 0.7);
    const Image expected = seenBy(*small, "accumulation");
    const auto error = [&](const char* method) { return rootMeanSquare(seenBy(*small, method), expected); };
    const double one = error("layered:layers=1");
    const double four = error("layered:layers=4");
    const double sixteen = error("layered:layers=16");
    EXPECT_LT(four, 0.7 * one);
    EXPECT_LT(sixteen, 0.5 * four);
}

TEST_F(Layered, whatLetsLightThroughShowsWhatLiesBehind) {
    const auto small = panes({{{20, 10, 60, 50, 1.2}, {0.5f, 0.1f, 0.1f, 0.5f}},
                              {{40, 20, 80, 60, 3}, {0.1f, 0.6f, 0.1f, 0.25f}},
                              {{10, 30, 90, 40, 5}, {0.9f, 0.9f, 0.2f, 1}}});
    blurBy(*small, 16, 1.2);
    EXPECT_LT(rootMeanSquare(seenBy(*small, "layered"), seenBy(*small, "accumulation")), 0.006);
}

TEST_F(Layered, aTransparentBackgroundKeepsCoverage) {
    const auto small = fiveSpheres();
    small->world.environment.visible = false;
    const Image image = seenBy(*small, "layered");
    EXPECT_LT(rootMeanSquare(image, seenBy(*small, "accumulation")), 0.015);
    EXPECT_EQ(image.at(159, 0)[3], 0);
}

RendererOptions wavesOf(std::uint32_t samples) {
    return {.wave = samples};
}

TEST_F(Layered, theSizeOfWavesChangesNoBit) {
    const auto small = fiveSpheres();
    const Image one = seenBy(*small, "layered", 72, wavesOf(1));
    EXPECT_EQ(one.pixels, seenBy(*small, "layered", 72, wavesOf(64)).pixels);
    const RendererOptions geometry{.geometryShaderLayers = true};
    EXPECT_EQ(one.pixels, seenBy(*small, "layered", 72, geometry).pixels);
}

std::string layeredFault(const SmallWorld& small, const RendererOptions& options = {}) {
    try {
        seenBy(small, "layered", 16, options);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

TEST_F(Layered, refusesByNameWhatItCannotDraw) {
    const auto small = fiveSpheres();
    small->view.lens.axialChromaticAberration = 0.1;
    EXPECT_EQ(layeredFault(*small), "");
    small->view.lens.focusTilt = 0.2;
    EXPECT_NE(layeredFault(*small).find("axial chromatic aberration"), std::string::npos);
    EXPECT_THROW(parseMethodUse("layered:layers=0"), Error);
    EXPECT_THROW(parseMethodUse("layered:layers=17"), Error);
}

}  // namespace
}  // namespace defocus::engine
