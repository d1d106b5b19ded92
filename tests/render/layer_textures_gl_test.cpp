// Tests textures of the KHR_materials extensions. For each texture slot, the tests check which channel is read, how it
// is decoded, and that it is multiplied by the slot's factor. Each pixel is compared with the value computed from its
// texel.

#include <gtest/gtest.h>

#include "render/sheen_equations.h"
#include "render/textured_wall.h"

namespace defocus::engine {
namespace {

using LayerTextures = LitWall;

// Returns a black material without reflection.
Material blackMaterial() {
    return {.baseColorFactor = {0, 0, 0, 1}, .metallicFactor = 0, .specularFactor = 0};
}

std::unique_ptr<SmallWorld> texturedWall(const Material& material, TextureUse Material::*slot) {
    auto small = litWall(material);
    (small->scene.materials[0].*slot).texture = addTexture(small->scene, 4, scrambled);
    return small;
}

// Returns the relative error of the texel's linear colour that the driver's sRGB decoding may cause.
glm::dvec3 relativeErrors(const Texel& texel) {
    return decodingErrors(texel) / decoded(texel);
}

// Expects a wall of `material` under two suns to have, at each texel, the radiance of the surface that `surfaceOf`
// computes from the texel.
void expectSurface(const Material& material, TextureUse Material::*slot,
                   const std::function<GltfSurface(const Texel&)>& surfaceOf, bool isColor = false) {
    const auto small = texturedWall(material, slot);
    small->world.lights = {sunFrom(fromWall(*small, {0.4, -0.2, -1}), 3), sunFrom(fromWall(*small, {-2, 0.5, -1}), 5)};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const GltfSurface surface = surfaceOf(texel);
        const glm::dvec3 expected = litRadiance(surface, point, point.normal, small->world.lights);
        const glm::dvec3 relative =
            2e-5 + 1e-6 / std::pow(surface.roughness, 4) + (isColor ? relativeErrors(texel) : glm::dvec3(0));
        expectRadiance(image, point, expected, relative * glm::max(expected, glm::dvec3(0.05)));
    });
}

// Adds a white sky that is visible through the wall but does not light any surface.
void lightFromBehind(SmallWorld& small) {
    small.world.environment.zenith = glm::vec3(1);
    small.world.environment.lighting = 0;
}

TEST_F(LayerTextures, redOfTransmissionLetsThrough) {
    Material glass = blackMaterial();
    glass.baseColorFactor = {1, 0.5f, 0.25f, 1};
    glass.roughnessFactor = 0;
    glass.transmissionFactor = 0.8f;
    const auto small = texturedWall(glass, &Material::transmission);
    lightFromBehind(*small);
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        expectRadiance(image, point, 0.8 * texel[0] / 255 * glm::dvec3(1, 0.5, 0.25), glm::dvec3(1e-5));
    });
}

// The green channel scales the thickness d in Beer-Lambert absorption, c^(d/D), with the attenuation colour c and the
// attenuation distance D.
TEST_F(LayerTextures, greenOfThicknessAbsorbs) {
    Material glass = blackMaterial();
    glass.baseColorFactor = glm::vec4(1);
    glass.roughnessFactor = 0;
    glass.transmissionFactor = 1;
    glass.thicknessFactor = 0.6f;
    glass.attenuationColor = {0.5f, 0.25f, 0.75f};
    glass.attenuationDistance = 0.5f;
    const auto small = texturedWall(glass, &Material::thickness);
    lightFromBehind(*small);
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const double thickness = 0.6 * texel[1] / 255;
        expectRadiance(image, point, glm::pow(glm::dvec3(0.5, 0.25, 0.75), glm::dvec3(thickness / 0.5)),
                       glm::dvec3(1e-5));
    });
}

Material glossyMaterial() {
    // an index of refraction of 2 means a reflectance of 1/9 at normal incidence
    return {.baseColorFactor = {0.2f, 0.1f, 0.3f, 1},
            .metallicFactor = 0,
            .roughnessFactor = 0.4f,
            .ior = 2,
            .specularFactor = 0.7f};
}

TEST_F(LayerTextures, alphaOfSpecularScalesTheReflectance) {
    expectSurface(glossyMaterial(), &Material::specular, [](const Texel& texel) {
        const double share = 0.7 * texel[3] / 255;
        return GltfSurface{{0.2, 0.1, 0.3}, 0, 0.4, glm::dvec3(share / 9), share};
    });
}

TEST_F(LayerTextures, specularColourIsDecodedAndScaled) {
    Material glossy = glossyMaterial();
    // a black base, because the base is dimmed by the largest channel of the reflectance
    glossy.baseColorFactor = {0, 0, 0, 1};
    glossy.specularColorFactor = {1, 0.5f, 2};
    expectSurface(
        glossy, &Material::specularColor,
        [](const Texel& texel) {
            const glm::dvec3 colored = glm::min(decoded(texel) * glm::dvec3(1, 0.5, 2) / 9.0, glm::dvec3(1));
            return GltfSurface{glm::dvec3(0), 0, 0.4, 0.7 * colored, 0.7};
        },
        true);
}

Material coatedMaterial() {
    Material result = blackMaterial();
    result.clearcoatFactor = 0.8f;
    result.clearcoatRoughnessFactor = 0.3f;
    return result;
}

TEST_F(LayerTextures, redOfClearcoatIsTheCoatedShare) {
    const auto small = texturedWall(coatedMaterial(), &Material::clearcoat);
    small->world.lights = {sunFrom(fromWall(*small, {0.3, -0.4, -1}), 3)};
    const GltfSurface coat{glm::dvec3(0), 0, 0.3};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const glm::dvec3 full = litRadiance(coat, point, point.normal, small->world.lights);
        expectLitRadiance(image, point, 0.8 * texel[0] / 255 * full, 0.3);
    });
}

TEST_F(LayerTextures, greenOfClearcoatRoughnessIsRoughness) {
    Material coated = coatedMaterial();
    coated.clearcoatFactor = 1;
    coated.clearcoatRoughnessFactor = 0.9f;
    expectSurface(coated, &Material::clearcoatRoughness, [](const Texel& texel) {
        return GltfSurface{glm::dvec3(0), 0, 0.9 * texel[1] / 255};
    });
}

TEST_F(LayerTextures, theClearcoatNormalTiltsTheCoat) {
    Material coated = coatedMaterial();
    coated.clearcoatFactor = 1;
    coated.clearcoatRoughnessFactor = 0.6f;
    coated.clearcoatNormalScale = 0.4f;
    const auto small = litWall(coated);
    const auto tilted = [](int column, int row) {
        const Texel texel = scrambled(column, row);
        return Texel{texel[0], texel[1], 220, 255};
    };
    small->scene.materials[0].clearcoatNormal.texture = addTexture(small->scene, 4, tilted);
    small->world.lights = {sunFrom(fromWall(*small, {0.3, -0.4, -1}), 3)};
    const GltfSurface coat{glm::dvec3(0), 0, 0.6};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const glm::dvec3 local(0.4 * (2 * texel[0] / 255.0 - 1), 0.4 * (2 * texel[1] / 255.0 - 1), 2 * 220 / 255.0 - 1);
        const glm::dvec3 normal = fromWall(*small, glm::normalize(local));
        expectLitRadiance(image, point, litRadiance(coat, point, normal, small->world.lights), 0.6);
    });
}

// Expects a wall of cloth to have, at each texel, the radiance of the sheen whose colour and roughness `sheenOfTexel`
// computes from the texel.
void expectSheen(const Material& cloth, TextureUse Material::*slot,
                 const std::function<std::pair<glm::dvec3, double>(const Texel&)>& sheenOfTexel, bool isColor = false) {
    const auto small = texturedWall(cloth, slot);
    small->world.lights = {sunFrom(fromWall(*small, {1.5, -0.4, -1}), 4)};
    const glm::dvec3 toLight = -glm::normalize(small->world.lights[0].direction);
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const auto& [color, roughness] = sheenOfTexel(texel);
        const double nl = glm::dot(point.normal, toLight), nv = glm::dot(point.normal, point.toEye);
        const double nh = glm::dot(point.normal, glm::normalize(toLight + point.toEye));
        const glm::dvec3 expected = 4 * nl * sheenOf(nl, nv, nh, roughness) * color;
        const glm::dvec3 relative = 0.001 + (isColor ? relativeErrors(texel) : glm::dvec3(0));
        expectRadiance(image, point, expected, relative * expected + 1e-5);
    });
}

TEST_F(LayerTextures, sheenColourIsDecodedAndScaled) {
    Material cloth = blackMaterial();
    cloth.sheenColorFactor = {0.5f, 1, 0.25f};
    cloth.sheenRoughnessFactor = 0.5f;
    expectSheen(
        cloth, &Material::sheenColor,
        [](const Texel& texel) { return std::pair(glm::dvec3(0.5, 1, 0.25) * decoded(texel), 0.5); }, true);
}

TEST_F(LayerTextures, alphaOfSheenRoughnessIsRoughness) {
    Material cloth = blackMaterial();
    cloth.sheenColorFactor = {0.5f, 1, 0.25f};
    cloth.sheenRoughnessFactor = 0.9f;
    expectSheen(cloth, &Material::sheenRoughness, [](const Texel& texel) {
        return std::pair(glm::dvec3(0.5, 1, 0.25), std::max(0.9 * texel[3] / 255, 0.1));
    });
}

}  // namespace
}  // namespace defocus::engine
