// Tests KHR_materials_ior, _specular, _clearcoat and _sheen: a wall's radiance against the specifications' equations in
// double precision, and energy in a white furnace.

#include <gtest/gtest.h>

#include "render/lit_wall.h"
#include "render/sheen_equations.h"

namespace defocus::engine {
namespace {

using MaterialLayers = LitWall;

Material material(const glm::vec3& base, float roughness) {
    return {.baseColorFactor = glm::vec4(base, 1), .metallicFactor = 0, .roughnessFactor = roughness};
}

// Returns a black material without reflection.
Material nothing() {
    Material result = material(glm::vec3(0), 1);
    result.specularFactor = 0;
    return result;
}

double reflectanceOf(double ior) {
    return std::pow((ior - 1) / (ior + 1), 2);
}

void expectWall(const Material& material, const GltfSurface& surface, double share = 1) {
    const auto small = litWall(material);
    small->world.lights = {sunFrom(fromWall(*small, {0.4, -0.2, -1}), 3), sunFrom(fromWall(*small, {-2, 0.5, -1}), 5)};
    const Image image = wallImage(*small);
    for (const WallPoint& point : wallPoints(*small))
        expectLitRadiance(image, point, share * litRadiance(surface, point, point.normal, small->world.lights),
                          surface.roughness);
}

TEST_F(MaterialLayers, theIndexOfRefractionSetsTheReflectance) {
    for (const double ior : {1.0, 1.33, 1.8, 2.42}) {
        Material glossy = material({0.1f, 0.2f, 0.4f}, 0.4f);
        glossy.ior = static_cast<float>(ior);
        const GltfSurface surface{{0.1f, 0.2f, 0.4f}, 0, 0.4f, glm::dvec3(reflectanceOf(ior))};
        expectWall(glossy, surface);
    }
    Material mirror = material(glm::vec3(1), 0.4f);
    mirror.ior = 0;
    expectWall(mirror, {glm::dvec3(1), 0, 0.4f, glm::dvec3(1)});
}

TEST_F(MaterialLayers, specularScalesAndColoursTheReflectance) {
    Material weak = material({0.5f, 0.2f, 0.4f}, 0.3f);
    weak.specularFactor = 0.25f;
    expectWall(weak, {{0.5f, 0.2f, 0.4f}, 0, 0.3f, glm::dvec3(0.01), 0.25});
    Material colored = material({0.5f, 0.2f, 0.4f}, 0.3f);
    colored.specularColorFactor = {0.2f, 0.9f, 0.5f};
    colored.ior = 2;
    expectWall(colored, {{0.5f, 0.2f, 0.4f}, 0, 0.3f, reflectanceOf(2) * glm::dvec3(0.2f, 0.9f, 0.5f)});
    colored.metallicFactor = 1;  // a metal, which ignores the specular colour and the index of refraction
    expectWall(colored, {{0.5f, 0.2f, 0.4f}, 1, 0.3f});
}

TEST_F(MaterialLayers, aCoatReflectsAsTheStandardsDielectricOfItsOwnRoughness) {
    Material coated = nothing();
    coated.clearcoatFactor = 0.5f;
    coated.clearcoatRoughnessFactor = 0.3f;
    expectWall(coated, {glm::dvec3(0), 0, 0.3f}, 0.5);
}

// At normal incidence, a smooth coat reflects ((1.5 − 1)/(1.5 + 1))² = 0.04 of the furnace's radiance of 1. A black
// base below the coat adds nothing. A base that emits a radiance of 1 adds 0.96 through the coat, so the sum is 1.
TEST_F(MaterialLayers, aSmoothCoatThrowsBackFourPercentFromStraightAhead) {
    Material coated = nothing();
    coated.clearcoatFactor = 1;
    const Image image = furnaceImage(coated, 1);
    EXPECT_NEAR(image.at(image.width / 2, image.height / 2)[0], 0.04, 0.01);
    Material glowing = coated;
    glowing.emissiveFactor = glm::vec3(1);
    EXPECT_LT(farthestFrom(furnaceImage(glowing, 1), glm::dvec3(1)), 1e-5)
        << "the coat reflects what it blocks of the glow";
}

constexpr float layerRoughnesses[] = {0, 0.1f, 0.3f, 0.6f, 1};
constexpr double viewCosines[] = {1, 0.8, 0.5, 0.2};

TEST_F(MaterialLayers, whiteLayersOnWhiteThrowBackAllOfTheLight) {
    for (const float roughness : layerRoughnesses)
        for (const double cosine : viewCosines) {
            Material white = material(glm::vec3(1), roughness);
            white.ior = 1.9f;
            white.specularFactor = 0.7f;
            EXPECT_LT(farthestFrom(furnaceImage(white, cosine), glm::dvec3(1)), 1e-5) << roughness << ' ' << cosine;
            white.clearcoatFactor = 0.8f;
            white.clearcoatRoughnessFactor = 1 - roughness;
            EXPECT_LT(farthestFrom(furnaceImage(white, cosine), glm::dvec3(1)), 1e-5) << roughness << ' ' << cosine;
            white.sheenColorFactor = glm::vec3(1);
            white.sheenRoughnessFactor = roughness;
            EXPECT_LT(farthestFrom(furnaceImage(white, cosine), glm::dvec3(1)), 1e-5) << roughness << ' ' << cosine;
        }
}

// Returns the albedo of sheen for the view cosine `nv`: ∫ D·V·(n·l) dl over the hemisphere, by the midpoint rule in
// √(n·l) and the azimuth.
double sheenAlbedo(double nv, double roughness) {
    constexpr int rings = 300, sectors = 300;
    const double sv = std::sqrt(1 - nv * nv);
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double root = (i + 0.5) / rings;
        const double nl = root * root;
        const double sl = std::sqrt(1 - nl * nl);
        for (int j = 0; j < sectors; ++j) {
            const double azimuth = std::numbers::pi * (j + 0.5) / sectors;
            const glm::dvec3 h(sv + sl * std::cos(azimuth), sl * std::sin(azimuth), nv + nl);
            sum += sheenOf(nl, nv, h.z / glm::length(h), roughness) * nl * 2 * root;
        }
    }
    return sum * 2 * std::numbers::pi / rings / sectors;
}

TEST_F(MaterialLayers, sheenThrowsBackItsIntegralOfAFurnacesLight) {
    for (const double roughness : {0.15, 0.3, 0.5, 0.75, 1.0})
        for (const double cosine : {1.0, 0.7, 0.4}) {
            Material velvet = nothing();
            velvet.sheenColorFactor = glm::vec3(1);
            velvet.sheenRoughnessFactor = static_cast<float>(roughness);
            const Image image = furnaceImage(velvet, cosine);
            // Mean of the four pixels around the view axis.
            const double seen =
                0.25 * (image.at(15, 11)[0] + image.at(16, 11)[0] + image.at(15, 12)[0] + image.at(16, 12)[0]);
            EXPECT_NEAR(seen, sheenAlbedo(cosine, roughness), 0.012) << roughness << ' ' << cosine;
        }
}

TEST_F(MaterialLayers, sheenUnderALightIsTheStandardsAndTakesFromTheBase) {
    for (const double roughness : {0.2, 0.5, 0.9}) {
        Material cloth = nothing();
        cloth.baseColorFactor = {0.5f, 0.25f, 0.5f, 1};
        cloth.sheenColorFactor = {0.25f, 0.5f, 0.125f};
        cloth.sheenRoughnessFactor = static_cast<float>(roughness);
        const auto small = litWall(cloth);
        small->world.lights = {sunFrom(fromWall(*small, {1.5, -0.4, -1}), 4)};
        const Image image = wallImage(*small);
        const std::vector<WallPoint> points = wallPoints(*small);
        for (std::size_t i = 0; i < points.size(); i += 101) {  // only every 101st point, as the integrals are slow
            const WallPoint& point = points[i];
            const glm::dvec3 l = -glm::normalize(small->world.lights[0].direction);
            const double nl = glm::dot(point.normal, l), nv = glm::dot(point.normal, point.toEye);
            const double nh = glm::dot(point.normal, glm::normalize(l + point.toEye));
            const double left = 1 - 0.5 * std::max(sheenAlbedo(nv, roughness), sheenAlbedo(nl, roughness));
            const glm::dvec3 expected = 4 * nl *
                                        (glm::dvec3(cloth.baseColorFactor) * (left / std::numbers::pi) +
                                         glm::dvec3(cloth.sheenColorFactor) * sheenOf(nl, nv, nh, roughness));
            ASSERT_NO_FATAL_FAILURE(expectRadiance(image, point, expected, 0.01 * expected));
        }
    }
}

}  // namespace
}  // namespace defocus::engine
