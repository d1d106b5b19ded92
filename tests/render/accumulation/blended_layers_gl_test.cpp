// Tests coverage and the number of samples that show each object, where alpha-blended surfaces overlap. The expected
// weight of a surface is alpha · Π (1 − alpha of each nearer surface).

#include <algorithm>
#include <cmath>
#include <map>

#include "likeness.h"
#include "render/accumulation/blended_panes.h"

namespace defocus::engine {
namespace {

const std::vector<Layer> onlyObjects = {Layer::objects};

Pane pane(float alpha, double depth) {
    return {alpha, facing(0, 0, depth, 4 * depth)};
}

// Returns a square at a depth of 3 m that is rotated about the image's vertical axis.
Pane turned(float alpha, double angle) {
    return {alpha, glm::rotate(facing(0, 0, 3, 9), angle, glm::dvec3(0, 1, 0))};
}

// Returns the fractions of a pixel's samples that show each object or material, by index.
std::map<std::size_t, double> sharesAt(const Drawn& frame, std::size_t pixel, Layer layer = Layer::objects) {
    const NumberCounts& counts = frame.layers.numbers.at(layer);
    const auto entries = static_cast<std::size_t>(counts.entries);
    std::map<std::size_t, double> shares;
    for (std::size_t e = 0; e < entries; ++e)
        if (const std::uint32_t entry = counts.values[pixel * entries + e]; entry != 0)
            shares[(entry >> 16) - 1] =
                static_cast<double>(entry & 0xffffu) / double{frame.layers.samples.pixels[pixel]};
    return shares;
}

double sumAt(const Drawn& frame, std::size_t pixel, Layer layer = Layer::objects) {
    double sum = 0;
    for (const auto& [index, share] : sharesAt(frame, pixel, layer)) sum += share;
    return sum;
}

struct Residual {
    double mean = 0;
    double rms = 0;
};

Residual errorOf(const std::vector<double>& errors) {
    Residual error;
    for (const double e : errors) {
        error.mean += e / static_cast<double>(errors.size());
        error.rms += e * e / static_cast<double>(errors.size());
    }
    error.rms = std::sqrt(error.rms);
    return error;
}

class BlendedLayer : public BlendedPanes {
protected:
    // Expects each object to have its `expected` fraction of a pixel's samples. The mean error over all pixels must
    // vanish, and the RMS error must not exceed that of random choices.
    static void expectShares(const Drawn& frame, const std::vector<double>& expected) {
        const auto samples = static_cast<double>(frame.plan.samples.size());
        const std::size_t pixels = frame.layers.coverage.pixels.size();
        for (std::size_t object = 0; object < expected.size(); ++object) {
            std::vector<double> errors;
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                errors.push_back(sharesAt(frame, pixel)[object] - expected[object]);
            const Residual error = errorOf(errors);
            // Standard deviation that the fraction of samples that show the object would have if each sample chose its
            // object at random.
            const double noise = std::sqrt(expected[object] * (1 - expected[object]) / samples);
            EXPECT_NEAR(error.mean, 0, 4 * noise / std::sqrt(static_cast<double>(pixels))) << object;
            EXPECT_LT(error.rms, 1.1 * noise) << object;
        }
    }
};

// Tests each data layer alone and all together. The slow test layer_combinations_gl_slow_test.cpp renders all pairs.
TEST_F(BlendedLayer, coverageIsThePicturesAlphaWithAnyLayer) {
    const auto small = overlappingPanes();
    expectCoverage(*small, everyLayer);
    for (const Layer layer : everyLayer) expectCoverage(*small, {layer});
}

TEST_F(BlendedLayer, countsOfSortedPanesAreTheirWeights) {
    const auto small = sceneOf({pane(0.5f, 1), pane(0.3f, 2), pane(0.6f, 3)});
    const Drawn frame = drawn(*small, 64, onlyObjects);
    ASSERT_TRUE(std::ranges::none_of(frame.plan.blendOrder, &BlendRun::stochastic));
    ASSERT_EQ(frame.plan.samples.size(), 64u);
    expectShares(frame, {0.5, 0.5 * 0.3, 0.5 * 0.7 * 0.6});
    for (const float coverage : frame.layers.coverage.pixels) ASSERT_NEAR(coverage, 1 - 0.5 * 0.7 * 0.4, 1e-5);
}

TEST_F(BlendedLayer, countsBeforeAnOpaqueWallFillThePixel) {
    const auto small = sceneOf({pane(0.5f, 1), pane(0.3f, 2), pane(1, 3)});
    const Drawn frame = drawn(*small, 64, {Layer::objects, Layer::materials});
    expectShares(frame, {0.5, 0.5 * 0.3, 0.5 * 0.7});
    for (std::size_t pixel = 0; pixel < frame.layers.coverage.pixels.size(); ++pixel) {
        ASSERT_EQ(sumAt(frame, pixel), 1);
        ASSERT_EQ(sharesAt(frame, pixel), sharesAt(frame, pixel, Layer::materials));
    }
}

// Two surfaces of one object, with alpha a and b, cover 1 − (1 − a)(1 − b) of a pixel.
TEST_F(BlendedLayer, surfacesOfOneObjectAreIndependent) {
    const auto small = sceneOf({pane(0.5f, 1)});
    Mesh& mesh = small->scene.meshes[0];
    for (std::size_t i = 0; i < 4; ++i)
        mesh.vertices.positions.push_back(mesh.vertices.positions[i] * glm::vec3(2, 2, 1) - glm::vec3(0, 0, 0.25f));
    mesh.vertices.normals.assign(8, {0, 0, 1});
    for (const std::uint32_t index : {4u, 5u, 6u, 4u, 6u, 7u}) mesh.primitives[0].indices.push_back(index);
    finish(*small);
    const Drawn frame = drawn(*small, 64, onlyObjects);
    ASSERT_TRUE(std::ranges::none_of(frame.plan.blendOrder, &BlendRun::stochastic));
    expectShares(frame, {0.75});
}

// At blurred edges, the fraction of samples that show the pane equals the pane's coverage. It would be biased if the
// choice of a sample depended on its lens point.
TEST_F(BlendedLayer, countsAtBordersAreUnbiased) {
    const auto small = sceneOf({{0.5f, facing(0, 0, 1, 0.15)}});
    small->view.width = 96;
    small->view.height = 72;
    const Drawn frame = drawn(*small, 64, onlyObjects);
    std::vector<double> errors;
    for (std::size_t pixel = 0; pixel < frame.layers.coverage.pixels.size(); ++pixel)
        if (const double covered = frame.layers.coverage.pixels[pixel]; covered > 0.05 && covered < 0.45)
            errors.push_back(sharesAt(frame, pixel)[0] - covered);
    ASSERT_GT(errors.size(), 150u);
    EXPECT_NEAR(errorOf(errors).mean, 0, 0.01);
    EXPECT_LT(errorOf(errors).rms, 0.045);
}

// With stochastic transparency, the data layers of a sample show the same surface as the sample's image.
TEST_F(BlendedLayer, countsOfStochasticPanesAreThePicturesAlpha) {
    const auto small = sceneOf({turned(0.4f, 0.6), turned(0.7f, -0.6)});
    RenderSettings settings = settingsFor(64, LodMode::off);
    settings.layers = onlyObjects;
    FramePlan plan = planFrame(small->world, small->view, settings);
    ASSERT_TRUE(std::ranges::any_of(plan.blendOrder, &BlendRun::stochastic));
    for (BlendRun& run : plan.blendOrder) run.stochastic = true;
    const Drawn frame = drawnBy(*small, std::move(plan));
    for (std::size_t pixel = 0; pixel < frame.layers.coverage.pixels.size(); ++pixel)
        ASSERT_NEAR(sumAt(frame, pixel), frame.picture.pixels[4 * pixel + 3], 1e-6) << pixel;
}

// One of two crossing panes is sorted, and the other is drawn by stochastic transparency.
TEST_F(BlendedLayer, countsOfCrossingPanesAreTheirWeights) {
    const auto small = sceneOf({turned(0.4f, 0.6), turned(0.7f, -0.6)});
    const Drawn frame = drawn(*small, 64, onlyObjects);
    ASSERT_TRUE(std::ranges::any_of(frame.plan.blendOrder, &BlendRun::stochastic));
    ASSERT_FALSE(std::ranges::all_of(frame.plan.blendOrder, &BlendRun::stochastic));
    for (const bool left : {true, false}) {
        std::vector<double> errors[2];
        for (std::size_t pixel = 0; pixel < frame.layers.coverage.pixels.size(); ++pixel) {
            const std::size_t column = pixel % 32;
            if (left ? column > 12 : column < 20) continue;
            auto shares = sharesAt(frame, pixel);
            errors[0].push_back(shares[0] - (left ? 0.4 : 0.4 * 0.3));
            errors[1].push_back(shares[1] - (left ? 0.7 * 0.6 : 0.7));
        }
        for (const std::vector<double>& objectErrors : errors) {
            EXPECT_NEAR(errorOf(objectErrors).mean, 0, 0.015) << left;
            EXPECT_LT(errorOf(objectErrors).rms, 0.066) << left;
        }
    }
}

}  // namespace
}  // namespace defocus::engine
