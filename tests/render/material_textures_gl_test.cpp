// Tests textured pixels against values computed from texels: which channel is read, how it is decoded, and where the
// texel lies on the surface.

#include <gtest/gtest.h>

#include "render/textured_wall.h"

namespace defocus::engine {
namespace {

using MaterialTextures = LitWall;

TEST_F(MaterialTextures, greenIsRoughnessAndBlueIsMetalness) {
    const Material material{.baseColorFactor = {0.9f, 0.5f, 0.2f, 1}, .metallicFactor = 0.8f, .roughnessFactor = 0.9f};
    const auto small = litWall(material);
    small->scene.materials[0].metallicRoughness.texture = addTexture(small->scene, 4, scrambled);
    small->world.lights = {sunFrom(fromWall(*small, {0.3, -0.4, -1}), 3)};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const GltfSurface surface{{0.9, 0.5, 0.2}, 0.8 * texel[2] / 255, 0.9 * texel[1] / 255};
        expectLitRadiance(image, point, litRadiance(surface, point, point.normal, small->world.lights),
                          surface.roughness);
    });
}

// Occlusion is read from the red channel. It darkens only the light of the environment, not the light of lamps or
// emission.
TEST_F(MaterialTextures, redOccludesTheEnvironmentOnly) {
    const Material material{.metallicFactor = 0, .occlusionStrength = 0.7f};
    const auto small = litWall(material);
    small->world.environment = {EnvironmentType::uniform, {0.5f, 0.8f, 1}, {}, {}, nullptr, 1};
    const Image open = wallImage(*small);
    small->scene.materials[0].occlusion.texture = addTexture(small->scene, 4, scrambled);
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const float* all = open.at(point.x, point.y);
        expectLitRadiance(image, point, (1 + 0.7 * (texel[0] / 255.0 - 1)) * glm::dvec3(all[0], all[1], all[2]), 1);
    });
    small->world.environment.zenith = {};
    small->scene.materials[0].emissiveFactor = {0.25f, 0, 0};
    small->world.lights = {sunFrom(fromWall(*small, {0.3, -0.4, -1}), 3)};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel&) {
        const glm::dvec3 lit = litRadiance({}, point, point.normal, small->world.lights);
        expectLitRadiance(image, point, lit + glm::dvec3(0.25, 0, 0), 1);
    });
}

// Emission is the decoded sRGB texel times a linear factor, which may exceed 1. It is visible without any lamp.
TEST_F(MaterialTextures, emissionIsDecodedAndScaled) {
    const Material material{.emissiveFactor = {5, 0.5f, 1}};
    const auto small = litWall(material);
    small->scene.materials[0].emissive.texture = addTexture(small->scene, 4, scrambled);
    const glm::dvec3 factor(5, 0.5, 1);
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        expectRadiance(image, point, factor * decoded(texel), factor * decodingErrors(texel));
    });
}

TEST_F(MaterialTextures, theNormalTextureTiltsTheNormal) {
    const Material material{.metallicFactor = 0, .normalScale = 0.6f};
    const auto small = litWall(material);
    const auto tilted = [](int column, int row) {
        const Texel texel = scrambled(column, row);
        return Texel{texel[0], texel[1], 220, 255};
    };
    small->scene.materials[0].normal.texture = addTexture(small->scene, 4, tilted);
    small->world.lights = {sunFrom(fromWall(*small, {0.3, -0.4, -1}), 3)};
    forTexels(*small, asTheyAre, [&](const Image& image, const WallPoint& point, const Texel& texel) {
        const glm::dvec3 local(0.6 * (2 * texel[0] / 255.0 - 1), 0.6 * (2 * texel[1] / 255.0 - 1), 2 * 220 / 255.0 - 1);
        const glm::dvec3 normal = fromWall(*small, glm::normalize(local));
        expectLitRadiance(image, point, litRadiance({}, point, normal, small->world.lights), 1);
    });
}

// An alpha mask discards pixels if the texture's alpha times the factor is below the cutoff. Pixels with an alpha equal
// to the cutoff are kept.
TEST_F(MaterialTextures, alphaMaskCutsHoles) {
    Material material = unlitMaterial({1, 1, 1, 0.5f});
    material.alphaMode = AlphaMode::mask;
    material.alphaCutoff = 0.25f;
    const auto small = litWall(material);
    small->world.environment.zenith = {0, 0, 1};
    const auto alpha = [](int column, int row) { return Texel{255, 0, 0, (4 * row + column) * 17}; };
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, 4, alpha);
    const Image image = wallImage(*small);
    int holes = 0, left = 0;
    for (const WallPoint& point : wallPoints(*small)) {
        const std::optional<glm::ivec2> at = texelAt(point.uv, 4);
        if (!at) continue;
        const bool cut = 0.5 * alpha(at->x, at->y)[3] / 255 < 0.25;
        ++(cut ? holes : left);
        ASSERT_NEAR(image.at(point.x, point.y)[0], cut ? 0 : 1, 1e-3) << at->x << ' ' << at->y;
        ASSERT_NEAR(image.at(point.x, point.y)[2], cut ? 1 : 0, 1e-3);
        ASSERT_EQ(image.at(point.x, point.y)[3], 1) << "opaque, or the opaque background";
    }
    EXPECT_GT(holes, 100);
    EXPECT_GT(left, 100);
    // At a cutoff of 1, texels with an alpha of 1 are kept if the alpha factor is also 1.
    small->scene.materials[0].baseColorFactor.a = 1;
    small->scene.materials[0].alphaCutoff = 1;
    const Image full = wallImage(*small);
    for (const WallPoint& point : wallPoints(*small)) {
        const std::optional<glm::ivec2> at = texelAt(point.uv, 4);
        if (!at) continue;
        ASSERT_NEAR(full.at(point.x, point.y)[0], *at == glm::ivec2(3, 3) ? 1 : 0, 1e-3);
    }
}

// Each texture has its own coordinate set and its own transform (KHR_texture_transform: offset, rotation
// counter-clockwise about the origin, scale).
TEST_F(MaterialTextures, transformsAndSetsAreEachTexturesOwn) {
    const Material material{.metallicFactor = 0, .emissiveFactor = {1, 1, 1}};
    const auto small = litWall(material);
    Mesh& mesh = small->scene.meshes[0];
    // second coordinate set: (0.2 + 0.6 u, 0.3 + 0.6 v)
    mesh.vertices.uv1 = {{0.2f, 0.9f}, {0.8f, 0.9f}, {0.8f, 0.3f}, {0.2f, 0.3f}};
    finish(*small);
    const int texture = addTexture(small->scene, 4, scrambled);
    const glm::dvec2 offset(0.3, -0.2), scale(0.7, 1.3);
    const double angle = 0.5;
    const glm::mat3 move(1, 0, 0, 0, 1, 0, float(offset.x), float(offset.y), 1);
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const glm::mat3 turn(c, -s, 0, s, c, 0, 0, 0, 1);
    const glm::mat3 stretch(float(scale.x), 0, 0, 0, float(scale.y), 0, 0, 0, 1);
    Material& m = small->scene.materials[0];
    m.emissive = {texture, 1, move * turn * stretch};
    m.occlusion = {texture, 0, glm::mat3(1)};
    small->world.environment.zenith = {};
    const auto transformed = [&](const glm::dvec2& uv) {
        const glm::dvec2 stretched = uv * scale;
        return offset + glm::dvec2(std::cos(angle) * stretched.x + std::sin(angle) * stretched.y,
                                   -std::sin(angle) * stretched.x + std::cos(angle) * stretched.y);
    };
    const auto repeated = [](const glm::dvec2& uv) { return uv - glm::floor(uv); };
    const auto expectDecoded = [](const Image& image, const WallPoint& point, const Texel& texel) {
        expectRadiance(image, point, decoded(texel), decodingErrors(texel));
    };
    forTexels(
        *small, [&](const glm::dvec2& uv) { return repeated(transformed(glm::dvec2(0.2, 0.3) + 0.6 * uv)); },
        expectDecoded);
    m.emissive.uvSet = 0;
    m.occlusion.uvSet = 1;
    forTexels(
        *small, [&](const glm::dvec2& uv) { return repeated(transformed(uv)); }, expectDecoded);
    m.emissive.uvTransform = glm::mat3(1);
    forTexels(*small, asTheyAre, expectDecoded);
}

TEST_F(MaterialTextures, coordinatesWrapAsTheTextureSays) {
    const auto folded = [](double u, Wrap wrap) {
        if (wrap == Wrap::clampToEdge) return std::clamp(u, 0.0, 1.0);
        if (wrap == Wrap::repeat) return u - std::floor(u);
        const double twice = u / 2 - std::floor(u / 2);
        return twice < 0.5 ? 2 * twice : 2 - 2 * twice;
    };
    const auto small = litWall(unlitMaterial(glm::vec4(1)));
    Mesh& mesh = small->scene.meshes[0];
    // texture coordinates run from −1.7 to 2.7 over the visible width of the wall
    for (glm::vec2& uv : mesh.vertices.uv0) uv = 6.0f * uv - 2.5f;
    finish(*small);
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, 4, scrambled);
    for (const Wrap wrapS : {Wrap::repeat, Wrap::clampToEdge, Wrap::mirroredRepeat})
        for (const Wrap wrapT : {Wrap::repeat, Wrap::clampToEdge, Wrap::mirroredRepeat}) {
            small->scene.textures[0].wrapS = wrapS;
            small->scene.textures[0].wrapT = wrapT;
            forTexels(
                *small,
                [&](const glm::dvec2& uv) {
                    const glm::dvec2 wide = 6.0 * uv - 2.5;
                    // With clamping, the edge texel extends to infinity, so any point beyond the edge maps to the
                    // centre of that texel.
                    const auto inside = [](double u, Wrap wrap) {
                        return wrap == Wrap::clampToEdge && (u < 0.25 || u > 0.75) ? (u < 0.5 ? 0.125 : 0.875) : u;
                    };
                    return glm::dvec2(inside(folded(wide.x, wrapS), wrapS), inside(folded(wide.y, wrapT), wrapT));
                },
                [](const Image& image, const WallPoint& point, const Texel& texel) {
                    expectRadiance(image, point, decoded(texel), decodingErrors(texel));
                });
        }
}

// Each of the 256 sRGB values of a base colour texture is decoded, then multiplied by the linear factor and the linear
// vertex colours.
TEST_F(MaterialTextures, allCodesOfABaseColourAreDecoded) {
    const auto small = litWall(unlitMaterial({0.5f, 1, 1, 1}));
    Mesh& mesh = small->scene.meshes[0];
    mesh.vertices.colors.assign(4, {1, 0.2f, 1, 1});
    finish(*small);
    const auto code = [](int column, int row) {
        const int i = 16 * row + column;
        return Texel{i, i, 255 - i, 255};
    };
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, 16, code);
    small->view.width = 96;
    small->view.height = 72;
    const auto nearestCode = [](double linear, int expected) {
        return std::abs(linear - linearOf(expected)) < decodingError(expected);
    };
    const Image image = wallImage(*small);
    std::array<int, 256> seen{};
    for (const WallPoint& point : wallPoints(*small)) {
        const std::optional<glm::ivec2> at = texelAt(point.uv, 16);
        if (!at) continue;
        const Texel texel = code(at->x, at->y);
        ++seen[static_cast<std::size_t>(texel[0])];
        const float* pixel = image.at(point.x, point.y);
        ASSERT_TRUE(nearestCode(2.0 * pixel[0], texel[0])) << texel[0] << ": " << pixel[0];
        ASSERT_TRUE(nearestCode(5.0 * pixel[1], texel[1])) << texel[1] << ": " << pixel[1];
        ASSERT_TRUE(nearestCode(pixel[2], texel[2])) << texel[2] << ": " << pixel[2];
    }
    // The texture has 256 texels with different sRGB values. At least 80 of them must be visible in the image.
    EXPECT_GT(std::ranges::count_if(seen, [](int times) { return times > 0; }), 80);
}

// Dark vertex colours stay accurate, since they are stored linearly with 16 bits. With 8 bits, the first colour would
// become zero.
TEST_F(MaterialTextures, darkVertexColoursAreKept) {
    const auto small = litWall(unlitMaterial(glm::vec4(1)));
    small->scene.meshes[0].vertices.colors.assign(4, {118.0f / 65535, 0.0005f, 0.3f, 1});
    finish(*small);
    const Image image = wallImage(*small);
    for (const WallPoint& point : wallPoints(*small))
        expectRadiance(image, point, {118.0 / 65535, 0.0005, 0.3}, glm::dvec3(8e-6));
}

// Vertex colours of a coarse level of detail are fitted, may lie outside [0, 1] and are not clamped.
TEST_F(MaterialTextures, fittedVertexColoursAreNotClamped) {
    const auto small = litWall(unlitMaterial({0.5f, 1, 1, 1}));
    small->scene.meshes[0].vertices.colors.assign(4, glm::vec4(1));
    finish(*small);
    Pyramid pyramid = small->world.pyramids[0];
    pyramid.levels.resize(1);
    PyramidLevel coarse = pyramid.levels[0];
    coarse.colors.assign(4, {1.5f, 0.25f, -0.125f, 1});
    pyramid.levels.push_back(coarse);
    small->world.pyramids.replace(0, std::move(pyramid));
    FramePlan plan = wallPlan(*small);
    plan.objects[0].fine.level = 1;
    plan.levelsUsed[0].assign(2, false);
    plan.levelsUsed[0][1] = true;
    const Image image = imageInFloats(small->world, plan);
    for (const WallPoint& point : wallPoints(*small))
        expectRadiance(image, point, {0.75, 0.25, -0.125}, glm::dvec3(1e-6));
}

// Texture filtering interpolates linear values, not sRGB-encoded values. The interpolation weights have at least 8
// bits.
TEST_F(MaterialTextures, filteringMixesLight) {
    const auto small = litWall(unlitMaterial(glm::vec4(1)));
    const auto code = [](int column, int) { return column == 0 ? Texel{0, 40, 255, 255} : Texel{255, 200, 90, 255}; };
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, 2, code);
    small->scene.textures[0].magnification = Filter::linear;
    small->scene.textures[0].wrapS = Wrap::clampToEdge;
    const Image image = wallImage(*small);
    for (const WallPoint& point : wallPoints(*small)) {
        const double right = std::clamp(2 * point.uv.x - 0.5, 0.0, 1.0);
        for (int c = 0; c < 3; ++c) {
            const double from = linearOf(code(0, 0)[static_cast<std::size_t>(c)]);
            const double to = linearOf(code(1, 0)[static_cast<std::size_t>(c)]);
            ASSERT_NEAR(image.at(point.x, point.y)[c], glm::mix(from, to, right),
                        std::abs(to - from) / 256 + decodingError(255));
        }
    }
}

}  // namespace
}  // namespace defocus::engine
