#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lod/pyramid/conserved.h"
#include "lod/shapes.h"

namespace defocus {
namespace {

// A quarter: what faces the light throws back 1/2 in the mean, and half of the sphere faces away.
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

// Normals that stand for others that differ wrap the light around.
TEST(LightMeans, ofShortNormalsAreThoseOfTheShaders) {
    Mesh mesh = flatGrid(4);
    for (glm::vec3& normal : mesh.vertices.normals) normal *= 0.8f;
    const LightMeans means =
        lightMeans({mesh.vertices.positions, mesh.vertices.normals, {}, mesh.primitives[0].indices, true}, 10);
    const auto directions = directionsToLights();
    for (std::size_t l = 0; l < lightCount; ++l) {
        const double cosine = directions[l].z;
        const double spread = (1 - 0.64) * (1 - cosine * cosine) / std::numbers::pi;
        EXPECT_NEAR(means[l], 0.5 * (0.8 * cosine + std::sqrt(0.64 * cosine * cosine + spread)), 1e-6);
    }
}

}  // namespace
}  // namespace defocus
