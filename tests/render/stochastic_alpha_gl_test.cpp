// Tests stochastic transparency. Where blended surfaces have no common order, the mean over the lens samples equals
// blending in depth order at each pixel.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "render/accumulation/accumulated.h"
#include "render/accumulation/accumulation.h"

namespace defocus::engine {
namespace {

constexpr glm::vec4 red(1, 0, 0, 0.4f);
constexpr glm::vec4 green(0, 1, 0, 0.7f);

// Returns two double-sided panes in one mesh that cross at the image's centre column, over a blue sky. The red pane is
// nearer in the left half of the image.
std::unique_ptr<SmallWorld> crossingPanes() {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh;
    for (const glm::vec4& color : {red, green}) {
        Material& material = small->scene.materials.emplace_back(unlitMaterial(color));
        material.alphaMode = AlphaMode::blend;
        material.doubleSided = true;
        const auto first = static_cast<std::uint32_t>(mesh.vertices.count());
        const float slope = color == red ? -0.5f : 0.5f;
        for (const glm::vec2 corner : {glm::vec2(-3, -3), {3, -3}, {3, 3}, {-3, 3}})
            mesh.vertices.positions.emplace_back(corner, slope * corner.x);
        mesh.primitives.push_back({static_cast<int>(small->scene.materials.size()) - 1,
                                   {first, first + 1, first + 2, first, first + 2, first + 3}});
    }
    mesh.vertices.normals.assign(mesh.vertices.count(), {0, 0, 1});
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::translate(glm::dmat4(1), {0, 0, -5}));
    small->world.environment = {EnvironmentType::uniform, {0, 0, 1}, {}, {}, nullptr, 1};
    small->view.width = 64;
    small->view.height = 48;
    finish(*small);
    return small;
}

glm::dvec4 over(const glm::vec4& front, const glm::dvec4& behind) {
    return glm::dvec4(glm::dvec3(front) * double{front.a}, front.a) + (1 - double{front.a}) * behind;
}

struct Comparison {
    glm::dvec4 mean{0};  // mean of the image, over the compared pixels
    double rms = 0;      // RMS of the differences from the expected colour
};

Comparison compareColumns(const Image& image, int left, int right, const glm::dvec4& expected) {
    Comparison result;
    double squares = 0;
    const double count = double{1} * (right - left) * image.height;
    for (int y = 0; y < image.height; ++y)
        for (int x = left; x < right; ++x)
            for (int c = 0; c < 4; ++c) {
                result.mean[c] += double{image.at(x, y)[c]} / count;
                squares += std::pow(double{image.at(x, y)[c]} - expected[c], 2);
            }
    result.rms = std::sqrt(squares / (4 * count));
    return result;
}

class StochasticAlpha : public Accumulation {};

TEST_F(StochasticAlpha, crossingPanesOfOneMeshAreRightOnBothSides) {
    for (const char* method : {"accumulation", "multirate"})
        for (const bool opaqueSky : {true, false}) {
            const auto small = crossingPanes();
            small->world.environment.visible = opaqueSky;
            const glm::dvec4 sky = opaqueSky ? glm::dvec4(0, 0, 1, 1) : glm::dvec4(0);
            const Image image =
                imageByMethod(method, small->world, planFrame(small->world, small->view, settingsFor(64)));
            const glm::dvec4 expected[] = {over(red, over(green, sky)), over(green, over(red, sky))};
            for (int side = 0; side < 2; ++side) {
                const Comparison found = compareColumns(image, 34 * side, 30 + 34 * side, expected[side]);
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(found.mean[c], expected[side][c], 0.003) << method << ' ' << side << ' ' << c;
                EXPECT_LT(found.rms, 0.03) << method << ' ' << side;
            }
        }
}

// A pixel's random thresholds for alpha are stratified over its samples, so with one triangle, the error of N samples
// is at most 1/N.
TEST_F(StochasticAlpha, oneTriangleErrsByOneSampleAtMost) {
    const auto small = crossingPanes();
    small->scene.meshes[0].primitives.pop_back();
    small->scene.meshes[0].primitives[0].indices.resize(3);
    std::vector<glm::vec3>& corners = small->scene.meshes[0].vertices.positions;
    corners[0] = {-9, -9, 4.5f};
    corners[1] = {9, -9, -4.5f};
    corners[2] = {0, 9, 0};
    finish(*small);
    RenderSettings settings = settingsFor(32);
    settings.keepAll = true;
    FramePlan plan = planFrame(small->world, small->view, settings);
    plan.blendOrder.at(0).stochastic = true;
    const Image image = imageInFloats(small->world, plan);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) ASSERT_NEAR(image.at(x, y)[0], 0.4, 1.0 / 32 + 1e-6) << x << ' ' << y;
}

TEST_F(StochasticAlpha, pixelsDoNotDependOnTheWave) {
    const auto small = crossingPanes();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(24));
    const auto imageInWavesOf = [&](std::uint32_t wave) {
        const RendererOptions options{.wave = wave};
        return imageOf(*makeAccumulationRenderer(small->world, options), plan);
    };
    const Image first = imageInWavesOf(1);
    const Image other = imageInWavesOf(8);
    EXPECT_EQ(std::memcmp(first.pixels.data(), other.pixels.data(), first.pixels.size() * sizeof(float)), 0);
}

// Returns a mesh of one primitive with two layers over a blue sky. The nearer layer is first in the index list.
std::unique_ptr<SmallWorld> twoLayers() {
    auto small = crossingPanes();
    Mesh& mesh = small->scene.meshes[0];
    mesh.vertices.colors.assign(4, green);
    mesh.vertices.colors.insert(mesh.vertices.colors.end(), 4, red);
    for (glm::vec3& position : mesh.vertices.positions) position.z = &position < &mesh.vertices.positions[4] ? 0.5f : 0;
    std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    indices.insert(indices.end(), mesh.primitives[1].indices.begin(), mesh.primitives[1].indices.end());
    mesh.primitives.pop_back();
    small->scene.materials[0].baseColorFactor = glm::vec4(1);
    finish(*small);
    return small;
}

TEST_F(StochasticAlpha, layersOfOnePrimitiveAreIndependent) {
    const auto small = twoLayers();
    RenderSettings settings = settingsFor(64);
    settings.keepAll = true;
    FramePlan plan = planFrame(small->world, small->view, settings);
    plan.blendOrder.assign(1, {});  // one entry for the only primitive
    plan.blendOrder[0].stochastic = true;
    const Image image = imageInFloats(small->world, plan);
    const glm::dvec4 expected = over(green, over(red, {0, 0, 1, 1}));
    const Comparison found = compareColumns(image, 0, image.width, expected);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(found.mean[c], expected[c], 0.003) << c;
    EXPECT_LT(found.rms, 0.03);
}

// If the layers of a primitive do not cross, they are sorted, even if the file lists the nearer layer first. A single
// lens sample then already gives the exact colour.
TEST_F(StochasticAlpha, layersOfOnePrimitiveAreSorted) {
    const auto small = twoLayers();
    for (const char* method : {"accumulation", "layered"}) {
        const Image image = imageByMethod(method, small->world, planFrame(small->world, small->view, settingsFor(1)));
        const Comparison found = compareColumns(image, 4, image.width - 4, over(green, over(red, {0, 0, 1, 1})));
        EXPECT_LT(found.rms, 2e-3) << method;
    }
}

}  // namespace
}  // namespace defocus::engine
