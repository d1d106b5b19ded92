// Tests astigmatism and coma: the moments of a point's blur against closed forms, and the sky against a mean over lens
// rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>

#include "bokeh.h"
#include "core/error.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "lens/aberrations.h"
#include "lod/pyramid/build_all.h"
#include "plan/visible/tiles.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"

namespace defocus::engine {
namespace {

using Aberrations = GlContextTest;

View viewOf(double astigmatism, double coma) {
    View view;
    view.width = 160;
    view.height = 120;
    view.lens.fStop = 2;
    view.lens.focusDistance = 2;
    view.lens.astigmatism = astigmatism;
    view.lens.coma = coma;
    return view;
}

RenderSettings fullDetail(std::uint32_t samples) {
    // keepAll: use the lens even if nothing is blurred, since a pinhole image has at most 16 samples
    return {.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
}

// The image of a bright point of 2 × 2 px in a window of 64 × 64 px around the point: its energy, its centre in px, and
// its second moments about the centre in px².
struct Spot {
    glm::dvec2 centre{0};
    glm::dmat2 moments{0};
    double energy = 0;
};

Spot spotAt(const View& view, const glm::dvec2& place, double depth, const char* method = "accumulation") {
    const Scene scene =
        rectangleScene(view, {{place.x - 1, place.y - 1, place.x + 1, place.y + 1, depth}}, glm::vec3(50));
    World world = flatWorld(scene, blackBackground());
    world.pyramids = buildPyramids(scene.meshes);
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const auto renderer = methodNamed(method).make(world, options);
    const int left = std::min(std::max(static_cast<int>(place.x) - 32, 0), view.width - 64);
    const int top = std::min(std::max(static_cast<int>(place.y) - 32, 0), view.height - 64);
    const Tile tile{{left, top, 64, 64}, {0, 0, view.width, view.height}};
    const Image image = imageOf(*renderer, tileOf(planFrame(world, view, fullDetail(4096)), tile));
    Spot spot;
    const auto sum = [&](const auto& add) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                add(double(image.at(x, y)[1]), glm::dvec2(left + x + 0.5, top + y + 0.5));
    };
    sum([&](double value, const glm::dvec2& at) {
        spot.energy += value;
        spot.centre += value * at;
    });
    spot.centre /= spot.energy;
    sum([&](double value, const glm::dvec2& at) {
        spot.moments += value / spot.energy * glm::outerProduct(at - spot.centre, at - spot.centre);
    });
    return spot;
}

constexpr glm::dvec2 middle{80, 60};
constexpr double perHalfWidth = 80;  // half the image's width, px
constexpr double inFocus = 2;        // distance of the point, equal to the focus distance, m
// Variance along an axis, in px², of the point without aberrations: 1/3 from its width of two pixels, and 1/12 from the
// jitter inside a pixel.
constexpr double ownVariance = 5.0 / 12;

// Astigmatism with the coefficient A turns a point at the image position m into a line towards the image's centre. m is
// relative to the centre, in units of half the image's width. Lens points l = (u, v) cover the unit disk with u along
// m. Over the disk E[u²] = 1/4, so the variance is (A·|m|²)²/4 along the line and 0 across it. Astigmatism also
// enlarges the area of a small spot's image through l by the factor 1 + 3·A·(m·l). The line's outer half is therefore
// brighter, which moves the mean by ¾·A²·|m|²·m.
TEST_F(Aberrations, astigmatismMakesLinesToTheCentre) {
    SKIP_ON_SECOND_DRIVER();
    constexpr double share = 0.05;  // coefficient A: length of the line at the left and right edges / image width
    for (const glm::dvec2& place : {glm::dvec2(138, 71), glm::dvec2(124, 93), glm::dvec2(40, 100)}) {
        const Spot sharp = spotAt(viewOf(0, 0), place, inFocus);
        const Spot line = spotAt(viewOf(share * 36, 0), place, inFocus);
        const glm::dvec2 field = (place - middle) / perHalfWidth;
        const double spread = perHalfWidth * share;
        const glm::dmat2 expected = spread * spread / 4 * glm::dot(field, field) * glm::outerProduct(field, field);
        for (int c = 0; c < 2; ++c)
            for (int r = 0; r < 2; ++r)
                EXPECT_NEAR(line.moments[c][r], expected[c][r] + (c == r ? ownVariance : 0),
                            0.03 * (expected[0][0] + expected[1][1]));
        EXPECT_NEAR(line.energy / sharp.energy, 1, 3e-3);
        const glm::dvec2 moved = 0.75 * share * spread * glm::dot(field, field) * field;
        EXPECT_NEAR(glm::distance(line.centre - sharp.centre, moved), 0, 0.02);
    }
}

// Coma with the coefficient B turns a point at the distance m from the image's centre into a comet. Distances are in
// units of half the image's width. Lens points l = (u, v) cover the unit disk with u along the line to the centre. A
// ray deviates by B·m·(3u² + v²) along this line and by 2·B·m·u·v across it. Over the disk, the mean deviation is B·m,
// and the variances are B²·m²/2 and B²·m²/6. Coma also enlarges the area of a small spot's image through l by the
// factor 1 + 4·B·|l|². With these factors as weights, the mean deviation is B·m·(1 + ⅔·B).
TEST_F(Aberrations, comaMakesComets) {
    // `share` is the coefficient B. At the left and right edges, the comet's tail is 1.5·B times as long as the image
    // is wide.
    for (const double share : {0.03, -0.03}) {
        const glm::dvec2 place(134, 60);
        const Spot sharp = spotAt(viewOf(0, 0), place, inFocus);
        const Spot comet = spotAt(viewOf(0, 1.5 * share * 36), place, inFocus);
        const double scale = share * (place.x - middle.x);
        EXPECT_NEAR(comet.energy / sharp.energy, 1 + 2 * share, 3e-3);
        EXPECT_NEAR(comet.centre.x - sharp.centre.x, scale * (1 + 2 * share / 3), 0.02 * std::abs(scale))
            << "points outwards for positive coma";
        EXPECT_NEAR(comet.centre.y, sharp.centre.y, 0.02);
        EXPECT_NEAR(comet.moments[0][0] - ownVariance, scale * scale / 2, 0.03 * scale * scale);
        EXPECT_NEAR(comet.moments[1][1] - ownVariance, scale * scale / 6, 0.03 * scale * scale);
        EXPECT_NEAR(comet.moments[0][1], 0, 0.01 * scale * scale);
    }
}

// Astigmatism lengthens the blur along one axis, here by L px. The image of a point with the circle of confusion c px
// has the variance (c + L)²/16 along this axis and c²/16 across it. c is negative in front of the focal plane. An
// astigmatic lens has two focal distances: at c = 0, a point becomes a line towards the image's centre; at c = −L, it
// becomes a line perpendicular to the line at c = 0.
TEST_F(Aberrations, astigmatismAddsToTheBlurAlongOneAxis) {
    const glm::dvec2 place(134, 60);
    const View plain = viewOf(0, 0);
    const View astigmatic = viewOf(5.4, 0);
    const double field = (place.x - middle.x) / perHalfWidth;
    const double line = 160 * 5.4 / 36 * field * field;
    for (const double depth : {1.93, 2.07}) {
        const double blur = circleOfConfusion(clipCircleOfConfusion(plain.lens, 160, 120), depth, 160);
        const Spot disk = spotAt(plain, place, depth);
        const Spot ellipse = spotAt(astigmatic, place, depth);
        EXPECT_NEAR(ellipse.energy / disk.energy, 1, 0.01);
        EXPECT_NEAR(ellipse.moments[1][1], disk.moments[1][1], 0.02 * line * line / 16);
        EXPECT_NEAR(ellipse.moments[0][0] - disk.moments[0][0], ((blur + line) * (blur + line) - blur * blur) / 16,
                    0.02 * line * line / 16);
    }
}

// Through an aberrated lens focused at infinity, each pixel shows the radiance of a gradient sky, averaged over the
// rays of the lens samples.
TEST_F(Aberrations, skyIsSeenThroughThem) {
    View view = viewOf(20, 20);
    view.lens.focusDistance = std::numeric_limits<double>::infinity();
    const Scene empty;
    Environment gradient = blackBackground();
    gradient.type = EnvironmentType::gradient;
    gradient.zenith = glm::vec3(8);
    gradient.horizon = glm::vec3(0.1f);
    gradient.nadir = glm::vec3(1);
    const World world = flatWorld(empty, gradient);
    const FramePlan plan = planFrame(world, view, fullDetail(64));
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const auto renderer = makeAccumulationRenderer(world, options);
    const Image image = imageOf(*renderer, plan);
    const double tanX = tanHalfHorizontalFov(view.lens);
    double moved = 0;
    for (int row = 0; row < view.height; row += 17)
        for (int column = 0; column < view.width; column += 23) {
            const glm::dvec2 ndc((column + 0.5) / view.width * 2 - 1, 1 - (row + 0.5) / view.height * 2);
            const auto radiance = [&](const glm::dvec2& at) {
                const glm::dvec3 direction = glm::normalize(glm::dvec3(at.x * tanX, at.y * tanX * 0.75, -1));
                return 0.1 + std::abs(direction.y) * ((direction.y > 0 ? 8.0 : 1.0) - 0.1);
            };
            double expected = 0;
            double straight = 0;
            for (const LensSample& sample : plan.samples) {
                const glm::dvec2 inPixel = 2.0 * glm::dvec2(sample.pixel) / glm::dvec2(view.width, view.height);
                const glm::dvec2 missed = aberration(plan.coc, ndc, glm::dvec2(sample.lens)) * glm::dvec2(1, 4.0 / 3);
                expected += radiance(ndc + inPixel - missed) / 64;
                straight += radiance(ndc + inPixel) / 64;
            }
            EXPECT_NEAR(image.at(column, row)[1], expected, 1e-4 * (1 + expected)) << column << ", " << row;
            moved = std::max(moved, std::abs(expected - straight));
        }
    EXPECT_GT(moved, 0.05);
}

TEST_F(Aberrations, methodsThatCannotSaySo) {
    const View view = viewOf(3, 0);
    for (const char* const method : {"line", "layered"})
        EXPECT_THROW(spotAt(view, {120, 80}, 2.2, method), Error) << method;
}

}  // namespace
}  // namespace defocus::engine
