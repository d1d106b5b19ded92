#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "gl/read_back.h"
#include "gl_context_test.h"
#include "image/tone_map.h"
#include "render/aov/work.h"
#include "render/display/display_pass.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using Work = GlContextTest;

constexpr std::uint32_t samples = 48;

RenderSettings manySamples() {
    return {.sampleCount = samples};
}

// Returns quads that face a 50 mm lens at f/1.4, focused at 2 m, in an image of 96 × 72 px. At depth z, the image is
// 0.72·z m wide.
std::unique_ptr<SmallWorld> facingQuads(const std::vector<glm::dmat4>& quads, const Material& material) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(material);
    small->scene.meshes.push_back(quad(0));
    for (const glm::dmat4& worldFromObject : quads) place(*small, 0, worldFromObject);
    small->world.environment = {EnvironmentType::uniform, glm::vec3(0.5f), {}, {}, nullptr};
    small->view.lens.fStop = 1.4;
    small->view.lens.focusDistance = 2;
    small->view.width = 96;
    small->view.height = 72;
    finish(*small);
    return small;
}

glm::dmat4 quadAt(double depth, const glm::dvec2& centre, const glm::dvec2& halfSize) {
    return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(centre, -depth)), glm::dvec3(halfSize, 1));
}

Image workOf(const SmallWorld& small) {
    return renderWork(small.world, planFrame(small.world, small.view, manySamples()));
}

void expectEverywhere(const Image& work, float expected) {
    for (const float value : work.pixels) ASSERT_EQ(value, expected);
}

// A quad of two triangles that is out of focus and fills the image touches each pixel exactly once in each lens sample.
TEST_F(Work, fullScreenPairTouchesEachPixelOnceASample) {
    const auto small = facingQuads({quadAt(1, {0, 0}, {2, 2})}, unlitMaterial(glm::vec4(1)));
    expectEverywhere(workOf(*small), samples);
}

TEST_F(Work, hiddenAndTransparentSurfacesCount) {
    Material blended = unlitMaterial(glm::vec4(0.2f));
    blended.alphaMode = AlphaMode::blend;
    for (const Material& material : {unlitMaterial(glm::vec4(1)), blended}) {
        const auto small =
            facingQuads({quadAt(1, {0, 0}, {2, 2}), quadAt(3, {0, 0}, {6, 6}), quadAt(5, {0, 0}, {9, 9})}, material);
        expectEverywhere(workOf(*small), 3 * samples);
    }
}

TEST_F(Work, backsCountOnlyWhereTheyAreDrawn) {
    const glm::dmat4 back = glm::rotate(quadAt(1, {0, 0}, {2, 2}), std::numbers::pi, glm::dvec3(0, 1, 0));
    Material material = unlitMaterial(glm::vec4(1));
    expectEverywhere(workOf(*facingQuads({back}, material)), 0);
    // A reflection turns the quad's back into its front.
    expectEverywhere(workOf(*facingQuads({glm::scale(back, glm::dvec3(1, 1, -1))}, material)), samples);
    material.doubleSided = true;
    expectEverywhere(workOf(*facingQuads({back}, material)), samples);
}

// In each lens sample, the lens point and the jitter shift a rectangle in the image. The rectangle covers the pixels
// whose centres lie inside it.
TEST_F(Work, rectangleSumsToThePixelCentresInsideItInEachSample) {
    const double depth = 0.6;
    const glm::dvec2 centre(0.0143, -0.0097);
    const glm::dvec2 half(0.0821, 0.0543);
    const auto small = facingQuads({quadAt(depth, centre, half)}, unlitMaterial(glm::vec4(1)));
    const FramePlan plan = planFrame(small->world, small->view, manySamples());
    const double perMetre = 96 / (0.72 * depth);
    const double blur = circleOfConfusion(plan.coc, depth, 96);
    ASSERT_LT(blur, -5);
    const auto centresIn = [](double min, double max) { return std::floor(max - 0.5) - std::ceil(min - 0.5) + 1; };
    double expected = 0;
    for (const LensSample& sample : plan.samples) {
        const glm::dvec2 shift = 0.5 * blur * glm::dvec2(sample.lens) - glm::dvec2(sample.pixel);
        const glm::dvec2 middle = glm::dvec2(48, 36) + centre * perMetre + shift;
        expected += centresIn(middle.x - half.x * perMetre, middle.x + half.x * perMetre) *
                    centresIn(middle.y - half.y * perMetre, middle.y + half.y * perMetre);
    }
    const Image work = renderWork(small->world, plan);
    const double sum = std::accumulate(work.pixels.begin(), work.pixels.end(), 0.0);
    // A pixel centre within 1/256 px of an edge may count as inside or outside. The tolerance is two rows of 2 · half.x
    // · perMetre pixels in one of the 48 samples.
    EXPECT_NEAR(sum, expected, 2 * half.x * perMetre * 2);
    EXPECT_NEAR(sum / samples, 4 * half.x * half.y * perMetre * perMetre, 0.01 * sum / samples);
}

// The work AOV counts the triangles that cover each pixel. The viewer adds a few samples per frame to it, until it
// contains all samples. The test does this for one view and then for another.
TEST_F(Work, growsToTheSameSumForViewAfterView) {
    const auto small = facingQuads({quadAt(0.6, {0.014, -0.01}, {0.08, 0.05}), quadAt(3, {0, 0}, {0.9, 0.2})},
                                   unlitMaterial(glm::vec4(1)));
    WorkPass pass(small->world);
    for (const double focus : {2.0, 0.7}) {
        small->view.lens.focusDistance = focus;
        const FramePlan plan = planFrame(small->world, small->view, manySamples());
        pass.begin(plan);
        EXPECT_EQ(pass.samples(), 0u);
        std::uint32_t steps = 1;
        while (pass.grow(0)) ++steps;
        EXPECT_GT(steps, 1u);
        EXPECT_EQ(pass.samples(), samples);
        EXPECT_EQ(readBack(pass.work(), 1).pixels, renderWork(small->world, plan).pixels);
    }
}

// The viewer shows the work AOV, the number of triangles that cover each pixel, in the colours of the heat map file.
TEST_F(Work, isShownInTheColoursOfItsFile) {
    const auto small = facingQuads({quadAt(0.6, {0.014, -0.01}, {0.08, 0.05}), quadAt(3, {0, 0}, {0.9, 0.2})},
                                   unlitMaterial(glm::vec4(1)));
    WorkPass pass(small->world);
    pass.begin(planFrame(small->world, small->view, manySamples()));
    pass.grow(std::numeric_limits<double>::infinity());
    DisplayPass display;
    DisplaySettings settings;
    settings.overlay = DisplayOverlay::work;
    display.draw({.first = &pass.work(), .work = &pass.work(), .workSamples = samples}, settings, 96, 72);
    const Image shown = readBack(display.texture(), 3);
    const Image expected = workColourMap(readBack(pass.work(), 1), samples);
    ASSERT_EQ(shown.pixels.size(), expected.pixels.size());
    float brightest = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        EXPECT_NEAR(shown.pixels[i], srgbEncode(expected.pixels[i]), 0.02f) << i;
        brightest = std::max(brightest, shown.pixels[i]);
    }
    EXPECT_GT(brightest, 0.4f);
}

TEST_F(Work, coloursAndSummaryFollowTheNumbers) {
    Image work(3, 1, 1);
    work.pixels = {0, 4 * samples, 20 * samples};
    const Image colours = workColourMap(work, samples);
    EXPECT_LT(colours.at(0, 0)[0], 0.001f);
    EXPECT_LT(colours.at(0, 0)[0], colours.at(1, 0)[0]);
    EXPECT_LT(colours.at(1, 0)[1], colours.at(2, 0)[1]);
    const WorkSummary summary = workSummary(work, samples);
    EXPECT_DOUBLE_EQ(summary.mean, 8);
    EXPECT_DOUBLE_EQ(summary.max, 20);
}

}  // namespace
}  // namespace defocus::engine
