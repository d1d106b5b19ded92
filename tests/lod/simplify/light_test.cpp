#include "lod/simplify/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// A sphere reflects a quarter of its colour on average: elements that face the light reflect 1/2 on average, and half
// of the sphere faces away.
TEST(LightMeans, ofASphereAreAQuarterOfItsColour) {
    const Mesh mesh = sphere(96, 48);
    const std::vector<glm::vec4> grey(mesh.vertices.count(), {0.2f, 0.4f, 0.6f, 1});
    const LitSurface surface{mesh.vertices.positions, mesh.vertices.normals, grey, mesh.primitives[0].indices, false};
    for (const double mean : lightMeans(surface, 1000)) EXPECT_NEAR(mean, 0.4 / 4, 2e-4);
}

TEST(LightMeans, ofASquareFollowTheCosine) {
    const Mesh mesh = flatGrid(4);
    const LightMeans means =
        lightMeans({mesh.vertices.positions, mesh.vertices.normals, {}, mesh.primitives[0].indices, false}, 10);
    const auto directions = directionsToLights();
    for (std::size_t l = 0; l < lightCount; ++l) EXPECT_NEAR(means[l], std::max(directions[l].z, 0.0), 1e-6);
}

// Averaged over all light directions, a surface element reflects a quarter of the light for any spread of its normals.
TEST(MeanCosine, overAllLightsIsAQuarter) {
    constexpr int heights = 4000;
    for (const float agreement : {0.05f, 0.3f, 0.6f, 0.8f, 0.9f, 0.97f, 0.99f, 0.999f, 1.0f}) {
        double sum = 0;
        for (int i = 0; i < heights; ++i) {
            const float cosine = (2 * static_cast<float>(i) + 1) / heights - 1;
            sum += static_cast<double>(meanCosine(agreement * cosine, cosine, normalSpread(agreement)));
        }
        EXPECT_NEAR(sum / heights, 0.25, 2.5e-4) << agreement;
    }
}

// meanCosine() agrees with a numerical integral: the mean of the clamped cosine between the light direction and normals
// that follow a von Mises-Fisher distribution with a known mean normal.
TEST(MeanCosine, isAboutThatOfTheNormalsThatOneStandsFor) {
    constexpr int count = 400;
    for (const double narrowness : {4.0, 10.0, 40.0, 200.0}) {
        const double agreement = 1 / std::tanh(narrowness) - 1 / narrowness;
        const float spread = normalSpread(static_cast<float>(agreement));
        for (const double cosine : {1.0, 0.8, 0.5, 0.2, -0.2, -0.5, -1.0}) {
            double sum = 0;
            for (int i = 0; i < count; ++i) {
                const double u = (i + 0.5) / count;
                const double height = 1 + std::log(u + (1 - u) * std::exp(-2 * narrowness)) / narrowness;
                const double radius = std::sqrt(1 - height * height) * std::sqrt(1 - cosine * cosine);
                for (int j = 0; j < count; ++j)
                    sum += std::max(height * cosine + radius * std::cos(2 * std::numbers::pi * (j + 0.5) / count), 0.0);
            }
            const auto c = static_cast<float>(cosine);
            EXPECT_NEAR(meanCosine(static_cast<float>(agreement) * c, c, spread), sum / (count * count), 0.021)
                << narrowness << ' ' << cosine;
        }
    }
}

// If all normals of a ball lean to one side, the fit turns them so that the ball reflects as much light as with its
// radial normals.
TEST(FitLight, findsTheNormalsOfTheLight) {
    const Mesh ball = sphere(24, 12);
    std::vector<glm::vec3> expected;
    for (const glm::vec3& position : ball.vertices.positions) expected.push_back(glm::normalize(position));
    std::vector<std::uint32_t> groups(expected.size());
    std::iota(groups.begin(), groups.end(), 0);
    for (std::size_t v = 0; v < groups.size(); ++v)
        for (std::size_t first = 0; first < v; ++first)
            if (glm::distance(ball.vertices.positions[v], ball.vertices.positions[first]) < 1e-6f) {
                groups[v] = static_cast<std::uint32_t>(first);
                break;
            }
    const std::vector<glm::vec4> shaded = [&] {
        std::vector<glm::vec4> colors;
        for (const glm::vec3& n : expected) colors.emplace_back(glm::vec3(n.x > 0 ? 0.9f : 0.2f), 1);
        return colors;
    }();
    const std::vector<std::uint32_t>& indices = ball.primitives[0].indices;
    std::vector<glm::vec3> rough;
    for (const glm::vec3& n : expected) rough.push_back(0.9f * n);
    const LightMeans target = lightMeans({ball.vertices.positions, rough, shaded, indices, true}, 20'000);
    const auto largestDifference = [&](const std::vector<glm::vec3>& normals) {
        const LightMeans means = lightMeans({ball.vertices.positions, normals, shaded, indices, true}, 20'000);
        double largest = 0;
        for (std::size_t l = 0; l < lightCount; ++l) largest = std::max(largest, std::abs(means[l] - target[l]));
        return largest;
    };
    std::vector<glm::vec3> normals;
    for (std::size_t v = 0; v < expected.size(); ++v)
        normals.push_back(0.9f * glm::normalize(expected[groups[v]] + glm::vec3(0.15f, 0.1f, -0.05f)));
    EXPECT_GT(largestDifference(normals), 0.01);
    fitLight(ball.vertices.positions, shaded, indices, groups, target, normals);
    EXPECT_LT(largestDifference(normals), 5e-4);
    for (std::size_t v = 0; v < normals.size(); ++v) {
        EXPECT_EQ(normals[v], normals[groups[v]]);
        EXPECT_NEAR(glm::length(normals[v]), 0.9f, 1e-5f);
    }
}

// Normals that already reflect the target amount of light stay bit-identical.
TEST(FitLight, leavesWhatFits) {
    const Mesh grid = flatGrid(8);
    std::vector<std::uint32_t> groups(grid.vertices.count());
    std::iota(groups.begin(), groups.end(), 0);
    std::vector<glm::vec3> normals = grid.vertices.normals;
    const LightMeans target = lightMeans({grid.vertices.positions, normals, {}, grid.primitives[0].indices, true}, 10);
    fitLight(grid.vertices.positions, {}, grid.primitives[0].indices, groups, target, normals);
    EXPECT_EQ(normals, grid.vertices.normals);
}

// The fit does not change normals if colours are NaN, infinite or huge, as in a damaged file.
TEST(FitLight, leavesWhatHasNoNumbers) {
    const Mesh grid = flatGrid(2);
    std::vector<std::uint32_t> groups(grid.vertices.count());
    std::iota(groups.begin(), groups.end(), 0);
    for (const float damage :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38f}) {
        const std::vector<glm::vec4> colors(groups.size(), glm::vec4(damage));
        std::vector<glm::vec3> normals = grid.vertices.normals;
        fitLight(grid.vertices.positions, colors, grid.primitives[0].indices, groups, {}, normals);
        EXPECT_EQ(normals, grid.vertices.normals) << damage;
    }
}

}  // namespace
}  // namespace defocus::engine
