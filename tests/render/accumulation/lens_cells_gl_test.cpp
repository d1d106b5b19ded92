// Tests images that are drawn with lens cells, which are regions of the lens. Each cell has one sample, whose image is
// blurred as a lens of the cell's size would blur it (plan/lens_cells/lens_cells.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bokeh.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "image/tone_map.h"
#include "likeness.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/pyramid.h"
#include "plan/sample_range.h"
#include "render/accumulation/lens_cell_renders.h"

namespace defocus::engine {
namespace {

// A frame that is drawn in blocks of samples equals a frame drawn as one block, even if images are read back in the
// middle of a block.
TEST_F(LensCellImages, blocksAreThoseOfTheWholeFrame) {
    const auto small = blurredSpheres();
    const FramePlan plan = planFrame(small->world, small->view, ratedSettings(192, LodMode::fractional));
    const RendererOptions few{.wave = 16};
    const auto full = rendererOf("multirate", small->world, few);
    const auto part = rendererOf("multirate", small->world, few);
    full->start(plan);
    part->start(samplesOf(plan, 0, 64));
    while (part->advance()) EXPECT_EQ(part->image().width, small->view.width);
    for (const std::uint32_t first : {64u, 128u}) {
        part->continueWith(samplesOf(plan, first, 64));
        while (part->advance()) part->image();
    }
    while (full->advance()) {
    }
    EXPECT_TRUE(sameBits(full->image(), part->image()));
}

// The image of method "auto" is bit-identical to the image of the method that it chooses: multirate where spheres are
// blurred by 8 px and more, and accumulation where they are sharp. The same "auto" renderer draws both cases.
TEST_F(LensCellImages, automaticMethodHasTheBitsOfItsChoice) {
    const auto blurred = blurredSpheres();
    const auto renderer = rendererOf(automaticMethod, blurred->world);
    View sharp = blurred->view;
    sharp.lens.fStop = 64;
    for (const auto& [view, name] : {std::pair{blurred->view, "multirate"}, {sharp, "accumulation"}}) {
        const FramePlan plan = planFrame(blurred->world, view, ratedSettings(32));
        EXPECT_EQ(drawnMethod(parseMethodUse(automaticMethod), plan).text(), name);
        EXPECT_TRUE(sameBits(imageOf(*renderer, plan), imageOf(*rendererOf(name, blurred->world), plan))) << name;
    }
}

TEST_F(LensCellImages, keepAllGivesTheSameBits) {
    const auto small = blurredSpheres();
    for (const LodMode lod : {LodMode::fractional, LodMode::continuous, LodMode::off}) {
        RenderSettings settings = ratedSettings(100, lod);
        ASSERT_GT(lensCellsOf(*small, settings).blur, 0);
        RenderSettings keepAll = settings;
        keepAll.keepAll = true;
        EXPECT_TRUE(sameBits(drawnBy("multirate", *small, settings), drawnBy("multirate", *small, keepAll)));
    }
}

// The image stays the same if a geometry shader sets gl_Layer, as on GPUs that cannot set gl_Layer in the vertex
// shader.
TEST_F(LensCellImages, geometryShaderLayersGiveTheSameImage) {
    const auto small = blurredSpheres();
    const RendererOptions options{.geometryShaderLayers = true};
    const RenderSettings settings = ratedSettings(64);
    EXPECT_LT(
        largestDifference(drawnBy("multirate", *small, settings), drawnBy("multirate", *small, settings, options)),
        1e-3);
}

TEST_F(LensCellImages, apertureZeroIsThePinhole) {
    const auto small = blurredSpheres();
    const RenderSettings settings = ratedSettings(64);
    small->view.lens.dofEnabled = false;
    const Image pinhole = drawnBy("multirate", *small, settings);
    EXPECT_TRUE(sameBits(pinhole, drawnBy("accumulation", *small, settings)));
    small->view.lens.dofEnabled = true;
    small->view.lens.blurScale = 0;
    EXPECT_TRUE(sameBits(pinhole, drawnBy("multirate", *small, settings)));
}

// Two panels of one colour touch along an edge, and one of them is much more blurred. The red wall behind the panels
// does not show as a line along the common edge.
TEST_F(LensCellImages, panelsThatTouchShowNoLineBetweenThem) {
    for (const double across : {0.0, 0.0031}) {
        SmallWorld small;
        small.scene.materials.push_back(unlitMaterial({0.5f, 0.5f, 0.5f, 1}));
        small.scene.materials.push_back(unlitMaterial({1, 0, 0, 1}));
        small.scene.meshes.push_back(quad(0));
        small.scene.meshes.push_back(quad(1));
        // One of the two panels slants away from the edge along which they touch.
        const glm::dmat4 edge = glm::translate(glm::dmat4(1), glm::dvec3(across, 0, -2.2));
        const glm::dmat4 panel =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-0.4, 0, 0)), glm::dvec3(0.4, 0.3, 1));
        const glm::dmat4 mirrored =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.4, 0, 0)), glm::dvec3(0.4, 0.3, 1));
        place(small, 0, edge * panel);
        place(small, 0, edge * glm::rotate(glm::dmat4(1), 1.2, glm::dvec3(0, 1, 0)) * mirrored);
        place(small, 1, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -9)), glm::dvec3(30)));
        small.view.width = 160;
        small.view.height = 96;
        small.view.lens.fStop = 0.25;
        small.view.lens.focusDistance = 2.1;
        finish(small);
        const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
        ASSERT_GT(lensCellsOf(small, ratedSettings(64)).classes(), 0);
        // Returns the largest error of pixels near the common edge of the two panels, away from their outer edges.
        const auto worst = [&](const char* method) {
            const Image image = drawnBy(method, small, ratedSettings(64), exact);
            double largest = 0;
            for (int y = 36; y < 60; ++y)
                for (int x = 70; x < 90; ++x)
                    for (int c = 0; c < 3; ++c) largest = std::max<double>(largest, std::abs(image.at(x, y)[c] - 0.5));
            return largest;
        };
        EXPECT_LT(worst("accumulation"), 1.0 / 255);
        EXPECT_LT(worst("multirate"), worst("accumulation") + 2.0 / 255);
    }
}

// A bright square of 4 × 4 px far behind the focal plane, on a black background.
struct FarLight {
    View view;
    World world;
    double blur = 0;  // diameter of the square's blur, px
};

FarLight farLight(double fStop) {
    FarLight light;
    light.view = bokehView(320, 320);
    light.view.lens.fStop = fStop;
    light.world = flatWorld(rectangleScene(light.view, {{158, 158, 162, 162, 6}}, {64, 64, 64}), blackBackground());
    light.world.pyramids = buildPyramids(light.world.scene->meshes);
    light.blur = blurDiameter(light.view, 6);
    return light;
}

Image imageOfLight(const char* method, const FarLight& light, std::uint32_t samples) {
    const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
    return imageOf(*rendererOf(method, light.world, exact), planFrame(light.world, light.view, ratedSettings(samples)));
}

// Returns the standard deviation of pixels in the inner 70 % of the blurred square's disk, divided by their mean.
double ripple(const Image& image, const FarLight& light) {
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (std::hypot(x + 0.5 - 160, y + 0.5 - 160) > 0.7 * light.blur / 2) continue;
            sum += image.at(x, y)[0];
            squares += std::pow(image.at(x, y)[0], 2);
            ++count;
        }
    return std::sqrt(squares / count - std::pow(sum / count, 2)) / (sum / count);
}

// With few samples, the blur of a bright square consists of separate copies of the square, one per sample. Method
// "multirate" blurs the image of each sample by its lens cell, the part of the lens that the sample represents. This
// blur fills the gaps between the copies.
TEST_F(LensCellImages, gapsBetweenCopiesAreFilled) {
    const FarLight light = farLight(0.1846);
    ASSERT_NEAR(light.blur, 40, 0.5);
    for (const std::uint32_t n : {4u, 32u, 64u})
        EXPECT_LT(ripple(imageOfLight("multirate", light, n), light),
                  0.5 * ripple(imageOfLight("accumulation", light, n), light))
            << n;
}

struct LightDisk {
    double energy = 0;
    double offMiddle = 0;  // distance from the bright disk's centroid to the image's centre, px
    double radius = 0;     // RMS radius of the bright disk, px
};

LightDisk diskOf(const Image& image) {
    LightDisk disk;
    double second = 0;
    glm::dvec2 middle(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double value = image.at(x, y)[0];
            const glm::dvec2 off(x + 0.5 - 160, y + 0.5 - 160);
            disk.energy += value;
            middle += value * off;
            second += value * glm::dot(off, off);
        }
    disk.offMiddle = glm::length(middle / disk.energy);
    disk.radius = std::sqrt(second / disk.energy);
    return disk;
}

constexpr double farLightEnergy = 64 * 16;

// Returns the RMS radius of the blurred bright square in px. Variances along an axis add up: c²/16 for the blur disk of
// diameter c, 4²/12 for the square of 4 px, and 1/12 each for a pixel's sample positions and for its area.
double expectedRadius(const FarLight& light) {
    return std::sqrt(2 * (light.blur * light.blur / 16 + 16.0 / 12 + 2.0 / 12));
}

// The lens blurs a bright square to a disk. Its energy, centre and RMS radius have the expected values, although the
// image of each sample is itself blurred, with σ = 0.4 to 6 px.
TEST_F(LensCellImages, aBlurredLightKeepsItsEnergyAndItsSpread) {
    for (const double fStop : {0.8, 0.4, 0.25, 0.17, 0.1, 0.06}) {
        const FarLight light = farLight(fStop);
        const LightDisk disk = diskOf(imageOfLight("multirate", light, 64));
        EXPECT_NEAR(disk.energy, farLightEnergy, 0.005 * farLightEnergy) << light.blur;
        EXPECT_LT(disk.offMiddle, 0.15) << light.blur;
        EXPECT_NEAR(disk.radius, expectedRadius(light), 0.2) << light.blur;
    }
}

// With few samples, the blurred disk of a bright square is as accurate as the samples' positions allow. Each position
// is rounded to a pixel, which has an RMS error of 1/√12 px along an axis.
TEST_F(LensCellImages, ofFewSamplesTheLightIsAsWide) {
    for (const std::uint32_t n : {4u, 5u, 7u})
        for (const double fStop : {0.4, 0.25, 0.1846}) {
            const FarLight light = farLight(fStop);
            const LightDisk disk = diskOf(imageOfLight("multirate", light, n));
            EXPECT_NEAR(disk.energy, farLightEnergy, 0.02 * farLightEnergy) << n << " " << light.blur;
            EXPECT_LT(disk.offMiddle, 2 * std::sqrt(2.0 / 12 / n)) << n << " " << light.blur;
            EXPECT_NEAR(disk.radius, expectedRadius(light), 0.05 * expectedRadius(light)) << n << " " << light.blur;
        }
}

// A scene of a single colour, with surfaces in front of and behind the focal plane, keeps that colour.
TEST_F(LensCellImages, constantSceneStaysConstant) {
    SmallWorld small;
    small.scene.materials.push_back(unlitMaterial({0.1f, 0.7f, 1.0f / 3, 1}));
    small.scene.meshes.push_back(quad(0));
    const auto put = [&](double x, double depth, double half) {
        place(small, 0, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, -depth)), glm::dvec3(half)));
    };
    put(-0.2, 1.2, 0.2);
    put(0.2, 2, 0.2);
    put(0, 6, 20);
    small.world.environment = blackBackground();
    small.view.width = 96;
    small.view.height = 64;
    small.view.lens.fStop = 0.2;
    small.view.lens.focusDistance = 2;
    finish(small);
    const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
    for (const std::uint32_t n : {16u, 64u, 100u}) {
        ASSERT_GT(lensCellsOf(small, ratedSettings(n)).inFront, 0);
        ASSERT_GT(lensCellsOf(small, ratedSettings(n)).behind, 0);
        const Image image = drawnBy("multirate", small, ratedSettings(n), exact);
        EXPECT_LT(relativeDifferenceFrom(image, {0.1f, 0.7f, 1.0f / 3}), 1e-5) << n;
    }
}

struct FenceColors {
    glm::vec4 fence;
    glm::vec4 wall;
    glm::vec3 background;
};

// Returns a fence of pickets at 2 m. Behind it stands a wall of pickets that ends within the frame.
std::unique_ptr<SmallWorld> fenceBeforeWall(double focus, const FenceColors& colors) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial(colors.fence));
    if (colors.fence.a < 1) small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials.push_back(unlitMaterial(colors.wall));
    small->scene.meshes.push_back(quad(0));
    small->scene.meshes.push_back(quad(1));
    const auto at = [](double x, double y, double depth) {
        return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(x, y, -depth)), 0.2, glm::dvec3(0, 0, 1));
    };
    for (int i = 0; i < 12; ++i) place(*small, 0, glm::scale(at((i - 5.5) * 0.12, 0, 2), glm::dvec3(0.03, 9, 1)));
    for (int i = 0; i < 4; ++i) place(*small, 1, glm::scale(at((i - 1.5) * 0.5, 0.3, 3), glm::dvec3(0.13, 0.9, 1)));
    small->world.environment = {EnvironmentType::uniform, colors.background, {}, {}, nullptr, 1};
    small->view.width = 160;
    small->view.height = 48;
    small->view.lens.fStop = 0.15;
    small->view.lens.focusDistance = focus;
    finish(*small);
    return small;
}

// Returns the largest difference of sRGB-encoded values. Skips pixels that a sharp object covers only in part, where
// `covered` is neither 0 nor 1.
double largestBesideOutlines(const Image& reference, const Image& image, const Image& covered) {
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double share = covered.at(x, y)[0];
            if (share > 1e-6 && share < 1 - 1e-6) continue;
            for (int c = 0; c < 3; ++c)
                largest = std::max<double>(largest,
                                           std::abs(srgbEncode(image.at(x, y)[c]) - srgbEncode(reference.at(x, y)[c])));
        }
    return largest;
}

// The background does not shine through the outlines of objects. Except at outlines of objects in focus, the error of
// method "multirate" is at most 2/255 larger than that of method "accumulation". The scenes are a sharp wall behind
// a blurred fence, and an opaque and a half-transparent sharp fence in front of a blurred wall.
TEST_F(LensCellImages, nothingShinesThroughOutlines) {
    SKIP_ON_SECOND_DRIVER();
    const FenceColors colors{{0.9f, 0.8f, 0.3f, 1}, {0.05f, 0.2f, 0.5f, 1}, {0.3f, 0.1f, 0.1f}};
    FenceColors glass = colors;
    glass.fence.a = 0.5f;
    Image covered;
    for (const auto& [focus, drawn] : {std::pair{3.0, colors}, {2.0, colors}, {2.0, glass}}) {
        const auto small = fenceBeforeWall(focus, drawn);
        const bool fenceIsSharp = focus == 2;
        const auto outlines = fenceIsSharp ? fenceBeforeWall(focus, {glm::vec4(1), {0, 0, 0, 1}, glm::vec3(0)})
                                           : fenceBeforeWall(focus, {glm::vec4(0), glm::vec4(1), glm::vec3(0)});
        if (!fenceIsSharp) outlines->view.lens.dofEnabled = false;
        // Both fences have the same outlines.
        if (drawn.fence.a == 1) covered = drawnBy("accumulation", *outlines, ratedSettings(1024));
        const Image reference = convergedImage(*small);
        for (const std::uint32_t n : {16u, 64u}) {
            const LensCells cells = lensCellsOf(*small, ratedSettings(n));
            ASSERT_GT(fenceIsSharp ? cells.behind : cells.inFront, 0);
            const Image alone = drawnBy("accumulation", *small, ratedSettings(n));
            const Image blurred = drawnBy("multirate", *small, ratedSettings(n));
            EXPECT_LT(largestBesideOutlines(reference, blurred, covered),
                      largestBesideOutlines(reference, alone, covered) + 2.0 / 255)
                << focus << ' ' << drawn.fence.a << ' ' << n;
            EXPECT_LT(compareImages(reference, blurred).rmse, 1.05 * compareImages(reference, alone).rmse)
                << focus << ' ' << n;
        }
    }
}

// The image does not pop when blur classes (groups of pixels with similar blur) come into use. The lens opens in small
// steps, from a blur below every class to several classes. No step changes the image by more than twice the mean change
// of its four neighbouring steps.
TEST_F(LensCellImages, nothingPopsWhereClassesBegin) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = blurredSpheres();
    const auto renderer = rendererOf("multirate", small->world);
    std::vector<double> changes;
    Image before;
    int max = 0;
    for (double fStop = 1; fStop > 0.075; fStop *= 0.98) {
        small->view.lens.fStop = fStop;
        const FramePlan plan = planFrame(small->world, small->view, ratedSettings(16));
        max = std::max(max, lensCells(plan).behind);
        Image image = imageOf(*renderer, plan);
        if (!before.empty()) changes.push_back(compareImages(before, image).rmse);
        before = std::move(image);
    }
    ASSERT_GE(max, 2);
    ASSERT_EQ(lensCellsOf(*small, ratedSettings(16)).behind, max);
    for (std::size_t i = 2; i + 2 < changes.size(); ++i) {
        const double around = (changes[i - 2] + changes[i - 1] + changes[i + 1] + changes[i + 2]) / 4;
        EXPECT_LT(changes[i], 2 * around) << i;
    }
}

// With more samples, lens cells shrink, the blur of their images vanishes, and the image converges to the reference.
// The error is compared with that of method "accumulation" at the same number of samples: it is below 60 % with 16
// samples, and never above 105 %.
TEST_F(LensCellImages, convergesToTheReference) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = blurredSpheres();
    const Image reference = convergedImage(*small);
    std::vector<double> errors;
    for (const std::uint32_t n : {16u, 64u, 256u}) {
        errors.push_back(compareImages(reference, drawnBy("multirate", *small, ratedSettings(n))).rmse);
        const double accumulated = compareImages(reference, drawnBy("accumulation", *small, ratedSettings(n))).rmse;
        EXPECT_LT(errors.back(), (n == 16 ? 0.6 : 1.05) * accumulated) << n;
    }
    for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], 0.7 * errors[i - 1]) << i;
}

}  // namespace
}  // namespace defocus::engine
