// Tests environments that vary with the direction: their radiance in a pixel, and the radiance that a surface reflects.
// Maps hold the radiance L(d) = 1 + linear and quadratic terms in d, which are spherical harmonics of the bands 0, 1
// and 2. The clamped cosine scales the bands by 1, 2/3 and 1/4 (Ramamoorthi and Hanrahan 2001), so the reflection of a
// matt surface is known.

#include <gtest/gtest.h>

#include "render/lit_wall.h"

namespace defocus::engine {
namespace {

using EnvironmentMaps = LitWall;

// `first` returns linear terms of the radiance L(d), and `second` traceless quadratic terms, so that each function lies
// in a single band of spherical harmonics. All axes differ, so that a test fails if axes are swapped or rotated.
glm::dvec3 first(const glm::dvec3& d) {
    return {0.3 * d.x + 0.2 * d.y - 0.1 * d.z, 0.35 * d.y, 0.3 * d.z};
}
glm::dvec3 second(const glm::dvec3& d) {
    return {0.2 * d.x * d.y + 0.1 * (d.x * d.x - d.z * d.z), 0.2 * d.y * d.z - 0.1 * (d.x * d.x - d.y * d.y),
            0.3 * d.x * d.z + 0.05 * (3 * d.z * d.z - 1)};
}
glm::dvec3 radianceFrom(const glm::dvec3& d) {
    return 1.0 + first(d) + second(d);
}
glm::dvec3 mattFrom(const glm::dvec3& normal) {
    return 1.0 + 2.0 / 3 * first(normal) + 0.25 * second(normal);
}

// Returns an environment whose map has its centre column at −z, its right half at +x and its first row at +y.
Environment mapEnvironment() {
    constexpr int height = 128;
    auto map = std::make_shared<Image>(2 * height, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const double polar = std::numbers::pi * (y + 0.5) / height;
            const double azimuth = std::numbers::pi * ((x + 0.5) / height - 1);
            const glm::dvec3 radiance = radianceFrom(
                {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)});
            for (int c = 0; c < 3; ++c) map->at(x, y)[c] = static_cast<float>(radiance[c]);
        }
    return {EnvironmentType::map, {}, {}, {}, map, 1};
}

// Bound on the error of the map, whose radiance is below 1.7 and has second derivatives below 4. Half floats have a
// rounding error of up to 2⁻¹¹·1.7. Linear interpolation between texels that are π/128 apart has an error of up to
// (π/128)²/8·4.
constexpr double mapError = 1.2e-3;

const std::vector<glm::dmat4>& turns() {
    static const std::vector<glm::dmat4> list = [] {
        std::vector<glm::dmat4> result;
        for (const auto& [azimuth, height] : {std::pair{0.0, 0.0}, {1.7, 0.3}, {-2.4, -0.8}, {3.0, 1.0}})
            result.push_back(
                glm::rotate(glm::rotate(glm::dmat4(1), azimuth, glm::dvec3(0, 1, 0)), height, glm::dvec3(1, 0, 0)));
        return result;
    }();
    return list;
}

// Returns a wall and its camera, both rotated by `turn`.
std::unique_ptr<SmallWorld> turnedWall(const Material& material, const glm::dmat4& turn) {
    auto small = litWall(material);
    small->view.worldFromCamera = turn;
    small->world.pose.objects[0].worldFromObject = glm::translate(turn, glm::dvec3(0, 0, -wallDepth));
    return small;
}

TEST_F(EnvironmentMaps, aPixelSeesTheDirectionItLooksIn) {
    for (const glm::dmat4& turn : turns()) {
        const auto small = turnedWall(Material{}, turn);
        const std::vector<WallPoint> points = wallPoints(*small);
        small->world.pose.objects.clear();
        small->world.environment = mapEnvironment();
        const Image image = wallImage(*small);
        for (const WallPoint& point : points)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(image.at(point.x, point.y)[c], radianceFrom(-point.toEye)[c], mapError)
                    << point.x << ' ' << point.y;
    }
}

// Returns the fraction of light that reaches a wall's diffuse layer. It is measured as the fraction that a black wall
// does not reflect under a uniform radiance of 1.
double shareOfMattPart(Material material, const glm::dmat4& turn) {
    material.baseColorFactor = {0, 0, 0, 1};
    const auto small = turnedWall(material, turn);
    small->world.environment.zenith = glm::vec3(1);
    return 1 - static_cast<double>(wallImage(*small).at(16, 12)[0]);
}

// A matt wall reflects the light of the hemisphere in front of it. The diffuse reflection is measured as the difference
// between a white and a black wall.
TEST_F(EnvironmentMaps, aMattWallGathersTheHemisphereBeforeIt) {
    for (const glm::dmat4& turn : turns())
        for (const float lighting : {1.0f, 0.5f}) {
            const Material white{.metallicFactor = 0};
            Material black = white;
            black.baseColorFactor = {0, 0, 0, 1};
            const auto small = turnedWall(white, turn);
            small->world.environment = mapEnvironment();
            small->world.environment.lighting = lighting;
            const Image bright = wallImage(*small);
            small->scene.materials[0] = black;
            const Image dark = wallImage(*small);
            const WallPoint middle = wallPoints(*small)[32 * 12 + 16];
            const double share = shareOfMattPart(white, turn);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(bright.at(16, 12)[c] - dark.at(16, 12)[c],
                            share * static_cast<double>(lighting) * mattFrom(middle.normal)[c], 1e-3);
        }
}

// A smooth white metal shows the radiance from the mirrored direction.
TEST_F(EnvironmentMaps, aMirrorShowsTheMirroredDirection) {
    for (const glm::dmat4& turn : turns()) {
        const Material mirror{.roughnessFactor = 0};
        const auto small = turnedWall(mirror, turn);
        small->world.environment = mapEnvironment();
        const Image image = wallImage(*small);
        for (const WallPoint& point : wallPoints(*small)) {
            const glm::dvec3 mirrored = 2 * glm::dot(point.normal, point.toEye) * point.normal - point.toEye;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(image.at(point.x, point.y)[c], radianceFrom(mirrored)[c], mapError)
                    << point.x << ' ' << point.y;
        }
    }
}

// A matt wall under a gradient sky has the radiance E(n)/π. The irradiance E(n) is summed numerically over the
// hemisphere in front of the wall. The renderer omits the spherical harmonics beyond the second band. The largest
// omitted band is the fourth: its coefficient is −3/32·(zenith + nadir − 2·horizon), in terms of the sky's radiances,
// and the clamped cosine scales it by −1/24.
TEST_F(EnvironmentMaps, aMattWallUnderAGradientGathersItsHemisphere) {
    const Environment sky = {
        EnvironmentType::gradient, {0.6f, 0.8f, 1.0f}, {0.4f, 0.5f, 0.6f}, {0.1f, 0.1f, 0.2f}, nullptr, 1};
    const auto radiance = [&](double height) {
        const glm::dvec3 pole = height > 0 ? sky.zenith : sky.nadir;
        return glm::mix(glm::dvec3(sky.horizon), pole, std::abs(height));
    };
    for (const glm::dmat4& turn : turns()) {
        const Material white{.metallicFactor = 0};
        Material black = white;
        black.baseColorFactor = {0, 0, 0, 1};
        const auto small = turnedWall(white, turn);
        small->world.environment = sky;
        const Image bright = wallImage(*small);
        small->scene.materials[0] = black;
        const Image dark = wallImage(*small);
        const double share = shareOfMattPart(white, turn);
        const glm::dmat3 wall(turn);
        glm::dvec3 sum(0);
        constexpr int steps = 200;
        for (int i = 0; i < steps; ++i)  // equal steps of sin²θ and φ have equal cosine-weighted solid angles
            for (int k = 0; k < steps; ++k) {
                const double sine = std::sqrt((i + 0.5) / steps), azimuth = 2 * std::numbers::pi * (k + 0.5) / steps;
                const glm::dvec3 local(sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1 - sine * sine));
                sum += radiance((wall * local).y) / double(steps * steps);
            }
        for (int c = 0; c < 3; ++c) {
            const double poles = std::abs(sky.zenith[c] + sky.nadir[c] - 2 * sky.horizon[c]);
            EXPECT_NEAR(bright.at(16, 12)[c] - dark.at(16, 12)[c], share * sum[c], 1.2 * 3 / 32 / 24 * poles + 1e-4);
        }
    }
}

}  // namespace
}  // namespace defocus::engine
