// Tests axial chromatic aberration and the cat's eye effect, measured on the bokeh of one bright point.
#include <gtest/gtest.h>

#include <cmath>

#include "bokeh.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "lod/pyramid/build_all.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"

namespace defocus::engine {
namespace {

class LensColour : public GlContextTest {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

struct Blob {
    glm::dvec3 energy{0};  // Σ radiance
    glm::dvec3 moment{0};  // mean squared distance from the centroid, weighted by radiance, px²
    glm::dvec2 centre{0};
};

Blob blobOf(const Image& image) {
    Blob blob;
    double energy = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double value = image.at(x, y)[c];
                blob.energy[c] += value;
                blob.centre += value * glm::dvec2(x + 0.5, y + 0.5);
                energy += value;
            }
    blob.centre /= energy;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const glm::dvec2 away = glm::dvec2(x + 0.5, y + 0.5) - blob.centre;
                blob.moment[c] += image.at(x, y)[c] * glm::dot(away, away) / blob.energy[c];
            }
    return blob;
}

Image renderedPoint(const View& view, double column, double row, double depth, const glm::vec3& background = {}) {
    Scene scene = rectangleScene(view, {{column - 1, row - 1, column + 1, row + 1, depth}}, glm::vec3(50));
    Environment environment = blackBackground();
    environment.zenith = environment.horizon = environment.nadir = background;
    World world = flatWorld(scene, environment);
    world.pyramids = buildPyramids(scene.meshes);
    const RenderSettings settings{.sampleCount = 4096, .lod = LodMode::off};
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const auto renderer = makeAccumulationRenderer(world, options);
    return imageOf(*renderer, planFrame(world, view, settings));
}

View viewOf(double fStop) {
    View view;
    view.width = 128;
    view.height = 96;
    view.lens.focalLength = 50;
    view.lens.horizontalAperture = 36;
    view.lens.fStop = fStop;
    view.lens.focusDistance = 2;
    return view;
}

// Each wavelength t, from 0 (red) to 1 (blue), has its own focus distance and a blur of diameter c(t). A uniform disk
// of diameter c has the second moment c²/8. A colour channel with weight w(t) therefore has the second moment
// E[w(t)·c(t)²]/8. The size of the point and the pixel filter add a constant, which is measured without the aberration.
TEST_F(LensColour, bandsHaveTheBlurOfTheirOwnFocus) {
    View view = viewOf(0.35);
    view.lens.axialChromaticAberration = 0.08;
    const double depth = 3.2;
    const Blob blob = blobOf(renderedPoint(view, 64, 48, depth));
    view.lens.axialChromaticAberration = 0;
    const Blob plain = blobOf(renderedPoint(view, 64, 48, depth));
    const double aperture = 0.05 / 0.35;
    glm::dvec3 expected(0);
    double central = 0;
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        const double inverseFocus = 1 / 2.0 + 3 * 0.08 * (t - 0.5);  // red light (t = 0) focuses farther away
        const double diameter = aperture * (inverseFocus - 1 / depth) * 128 / 0.72;
        const double middle = aperture * (1 / 2.0 - 1 / depth) * 128 / 0.72;
        const glm::dvec3 weight(2 * (1 - t), 1.5 * (1 - (2 * t - 1) * (2 * t - 1)), 2 * t);
        expected += weight * diameter * diameter / 8.0 / double(steps);
        central += middle * middle / 8 / steps;
    }
    EXPECT_NEAR(plain.moment.r - central, plain.moment.b - central, 1e-6);
    const double box = plain.moment.g - central;  // second moment added by the point's size and the pixel filter
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(blob.moment[c], expected[c] + box, 0.02 * expected[c]) << "channel " << c;
        EXPECT_NEAR(blob.energy[c] / plain.energy[c], 1, 0.01) << "channel " << c;
    }
    EXPECT_GT(blob.moment.b, 1.1 * blob.moment.r) << "behind the focus blue is blurred more";
}

// A grey scene stays grey under chromatic aberration and under the cat's eye effect. Both together are not tested:
// pixels would use different subsets of the samples, and sampling noise would tint them.
TEST_F(LensColour, greyStaysGrey) {
    const Scene empty;
    Environment grey = blackBackground();
    grey.zenith = grey.horizon = grey.nadir = glm::vec3(0.37f);
    const World world = flatWorld(empty, grey);
    for (const std::uint32_t samples : {1u, 7u, 64u, 100u})
        for (const bool catEye : {false, true}) {
            View view = viewOf(1);
            (catEye ? view.lens.catEye : view.lens.axialChromaticAberration) = 0.7;
            const RenderSettings settings{.sampleCount = samples, .keepAll = true};
            const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
            const auto renderer = makeAccumulationRenderer(world, options);
            const Image image = imageOf(*renderer, planFrame(world, view, settings));
            for (std::size_t i = 0; i < image.pixels.size(); i += 4)
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(image.pixels[i + c], 0.37f, 1e-5) << samples << " samples, cat's eye: " << catEye;
        }
}

// With the cat's eye effect, the aperture seen from the image's corner is the intersection of two circles that are
// `catEye` radii apart: the aperture and the rim of the lens barrel. Its short axis points towards the image's centre.
// The brightness is unchanged, because the remaining rays have larger weights.
TEST_F(LensColour, catEyeIsTheLensOfTwoCircles) {
    View view = viewOf(0.35);
    view.lens.catEye = 0.8;
    const double depth = 6;
    const Image inCorner = renderedPoint(view, 108, 16, depth);
    view.lens.catEye = 0;
    const Blob round = blobOf(renderedPoint(view, 108, 16, depth));
    const Blob cut = blobOf(inCorner);

    // Second moments of the clipped bokeh along and across the direction to the image's centre.
    const glm::dvec2 outward = glm::normalize(glm::dvec2(108 - 64, 16 - 48));
    double along = 0;
    double across = 0;
    for (int y = 0; y < inCorner.height; ++y)
        for (int x = 0; x < inCorner.width; ++x) {
            const glm::dvec2 away = glm::dvec2(x + 0.5, y + 0.5) - cut.centre;
            const double weight = inCorner.at(x, y)[0] / cut.energy.r;
            along += weight * std::pow(glm::dot(away, outward), 2);
            across += weight * std::pow(away.x * outward.y - away.y * outward.x, 2);
        }

    // Expected second moments of the bokeh. A lens point counts if it lies inside the aperture and inside the rim of
    // the lens barrel, a circle of the same size. The position of the rim depends on the pixel that the ray through the
    // lens point hits.
    const double diameter = 0.05 / 0.35 * (1 / 2.0 - 1 / depth) * 128 / 0.72;
    const double corner = std::sqrt(1 + 0.75 * 0.75);
    double expectedAlong = 0;
    double expectedAcross = 0;
    double count = 0;
    glm::dvec2 mean(0);
    std::vector<glm::dvec2> points;
    for (int i = -200; i <= 200; ++i)
        for (int j = -200; j <= 200; ++j) {
            const glm::dvec2 lens(i / 200.0, j / 200.0);  // lens point: x grows to the right, y upwards
            if (glm::dot(lens, lens) > 1) continue;
            const glm::dvec2 pixel(108 + 0.5 * diameter * lens.x, 16 - 0.5 * diameter * lens.y);
            const glm::dvec2 place((pixel.x - 64) / 64 / corner, -(pixel.y - 48) / 64 / corner);
            if (glm::length(lens + 0.8 * place) > 1) continue;
            points.push_back(pixel);
            mean += pixel;
            count += 1;
        }
    mean /= count;
    for (const glm::dvec2& point : points) {
        expectedAlong += std::pow(glm::dot(point - mean, outward), 2) / count;
        expectedAcross += std::pow((point.x - mean.x) * outward.y - (point.y - mean.y) * outward.x, 2) / count;
    }
    EXPECT_LT(along, 0.75 * across) << "narrower towards the centre";
    EXPECT_NEAR(along / across, expectedAlong / expectedAcross, 0.08);
    EXPECT_NEAR(glm::length(cut.centre - mean), 0, 0.4);
    EXPECT_LT(glm::dot(cut.centre - round.centre, outward), -0.5) << "the remaining part lies towards the centre";
}

}  // namespace
}  // namespace defocus::engine
