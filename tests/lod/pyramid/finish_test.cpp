// Tests how materials influence the images from which a level's error is measured.

#include "lod/pyramid/finish.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "lod/pyramid/blurred_error.h"
#include "lod/pyramid/file.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

constexpr int texelsAcross = 64;

// Returns a texture with black and white columns, eight texels wide, in the lower half. The upper half is white.
TextureImage stripedTexture() {
    TextureImage image{texelsAcross, texelsAcross, {}};
    for (int y = 0; y < texelsAcross; ++y)
        for (int x = 0; x < texelsAcross; ++x) {
            const std::uint8_t value = y < texelsAcross / 2 || x / 8 % 2 == 0 ? 255 : 0;
            image.rgba.insert(image.rgba.end(), {value, value, value, 255});
        }
    return image;
}

// Returns a ball whose material has the striped texture, mapped by the azimuth.
Scene texturedBall() {
    Scene scene;
    Mesh mesh = sphere(96, 48);
    for (const glm::vec3& p : mesh.vertices.positions)
        mesh.vertices.uv0.push_back({0.5f + std::atan2(p.y, p.x) / 6.2831853f, 0.75f});
    mesh.primitives.front().material = 0;
    scene.meshes = {mesh};
    scene.images = {stripedTexture()};
    scene.textures.push_back({.image = 0});
    scene.materials.emplace_back();
    scene.materials[0].metallicFactor = 0;
    scene.materials[0].baseColor.texture = 0;
    return scene;
}

// Returns a pyramid of two levels. Level 1 is a copy of level 0 modified by `change`.
Pyramid withFinish(const Mesh& mesh, const Finish& finish, const std::function<void(PyramidLevel&)>& change) {
    Pyramid pyramid = fullDetail(mesh);
    for (glm::vec3& normal : pyramid.levels[0].normals) normal = glm::normalize(normal);
    pyramid.levels.push_back(pyramid.levels[0]);
    change(pyramid.levels[1]);
    measureBlurredErrors(pyramid, std::array{finish});
    return pyramid;
}

void turnNormals(PyramidLevel& level, float angle) {
    for (glm::vec3& n : level.normals)
        n = {std::cos(angle) * n.x - std::sin(angle) * n.y, std::sin(angle) * n.x + std::cos(angle) * n.y, n.z};
}

TEST(Finish, texturesAreLinearBetweenTexelsAndWrap) {
    const Scene scene = texturedBall();
    const Finish finish = Finishes(scene).of(0);
    const auto at = [&](float u, float v) { return finish.baseColorMap.at({u, v}, glm::vec2(0)).x; };
    EXPECT_NEAR(at(4.0f / texelsAcross, 0.75f), 1, 1e-6);
    EXPECT_NEAR(at(12.0f / texelsAcross, 0.75f), 0, 1e-6);
    EXPECT_NEAR(at(8.0f / texelsAcross, 0.75f), 0.5, 1e-5) << "between a white and a black texel";
    EXPECT_NEAR(at(12.0f / texelsAcross, 0.25f), 1, 1e-6) << "row 0 is at the top";
    EXPECT_NEAR(at(4.0f / texelsAcross - 3, 2.75f), 1, 1e-5);
    EXPECT_NEAR(at(12.0f / texelsAcross + 5, -0.25f), 0, 1e-5);
    EXPECT_EQ(at(std::nanf(""), 0), 1);
}

TEST(Finish, largeTexturesAreMeansOfLinearLight) {
    Scene scene = texturedBall();
    scene.images[0] = {2 * FinishImage::maxSide, 1, {}};
    for (int x = 0; x < scene.images[0].width; ++x) {
        const std::uint8_t value = x % 2 == 0 ? 0 : 255;
        scene.images[0].rgba.insert(scene.images[0].rgba.end(), {value, value, value, 255});
    }
    EXPECT_NEAR(Finishes(scene).of(0).baseColorMap.at({0.3f, 0.5f}, {}).x, 0.5, 0.005) << "up to 8-bit rounding";
}

TEST(Finish, wrapsMirrorAndClamp) {
    Scene scene = texturedBall();
    scene.textures[0].wrapS = Wrap::mirroredRepeat;
    scene.textures[0].wrapT = Wrap::clampToEdge;
    scene.images[0] = {2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 255}};
    const Finish finish = Finishes(scene).of(0);
    const auto at = [&](float u, float v) { return finish.baseColorMap.at({u, v}, glm::vec2(0)).x; };
    EXPECT_EQ(at(1.25f, -7), 1);
    EXPECT_EQ(at(1.75f, -7), 0);
    EXPECT_EQ(at(-0.25f, -7), 0);
    EXPECT_EQ(at(0.25f, 7), 1);
}

// If the texture of a level is shifted by half a period of its stripes, the level shows the opposite colours of level
// 0. The error is large until a blur hides the stripes of both levels.
TEST(Finish, aTextureThatMovesCountsUntilTheBlurHidesIt) {
    const Scene scene = texturedBall();
    const Finish finish = Finishes(scene).of(0);
    const auto moved = [&](float texels) {
        return withFinish(scene.meshes[0], finish, [&](PyramidLevel& level) {
            for (glm::vec2& uv : level.uv0) uv.x += texels / texelsAcross;
        });
    };
    const Pyramid opposite = moved(8);
    EXPECT_GT(squaredError(opposite, 1, 0), 10 * squaredError(moved(0.5f), 1, 0));
    EXPECT_LT(squaredError(moved(16), 1, 0), 1e-3 * squaredError(opposite, 1, 0)) << "a full period";
    EXPECT_LT(squaredError(opposite, 1, 2), 0.02 * squaredError(opposite, 1, 0));
    EXPECT_GT(squaredContrast(opposite, 2), 0.5);
}

TEST(Finish, whatIsUnlitHasNoNormals) {
    const Mesh mesh = sphere(96, 48);
    const auto error = [&](const Finish& finish) {
        return squaredError(withFinish(mesh, finish, [](PyramidLevel& level) { turnNormals(level, 0.1f); }), 1, 0);
    };
    EXPECT_LT(error({.unlit = true}), 1e-8);
    EXPECT_GT(error({}), 1e-4);
}

// The smoother a metal is, the more a small error of the normals moves its highlights.
TEST(Finish, smoothMetalsShowFineNormals) {
    const Mesh mesh = sphere(96, 48);
    double last = 0;
    for (const float roughness : {1.0f, 0.6f, 0.4f}) {
        const double error =
            squaredError(withFinish(mesh, {.metallic = 1, .roughness = roughness, .reflectance = 0.04f},
                                    [](PyramidLevel& level) { turnNormals(level, 0.05f); }),
                         1, 0);
        EXPECT_GT(error, 1.5 * last) << roughness;
        last = error;
    }
}

// Radiance above white is clamped: a surface whose radiance is a hundred times the mean looks the same at twice that
// radiance.
TEST(Finish, lightBeyondWhiteIsWhite) {
    Mesh mesh = sphere(96, 48);
    for (const glm::vec3& p : mesh.vertices.positions)
        mesh.vertices.colors.emplace_back(glm::vec3(p.x > 0.9f && p.y > 0 ? 1000 : 1), 1);
    const auto error = [&](float factor) {
        return squaredError(withFinish(mesh, {.unlit = true},
                                       [&](PyramidLevel& level) {
                                           for (glm::vec4& color : level.colors)
                                               if (color.x > 500) color *= factor;
                                       }),
                            1, 0);
    };
    EXPECT_LT(error(2), 0.01 * error(0));
}

TEST(Finish, theHashFollowsAllThatIsSeen) {
    const Scene scene = texturedBall();
    const auto hash = [&](const std::function<void(Scene&)>& change) {
        Scene changed = scene;
        change(changed);
        return Finishes(changed).hash(changed.meshes[0]);
    };
    const std::uint64_t own = hash([](Scene&) {});
    EXPECT_EQ(own, hash([](Scene& s) { s.materials[0].name = "another"; }));
    EXPECT_EQ(own, hash([](Scene& s) { s.materials.emplace_back().roughnessFactor = 0.3f; }));
    const std::vector<std::function<void(Scene&)>> changes = {
        [](Scene& s) { s.materials[0].roughnessFactor = 0.5f; },
        [](Scene& s) { s.materials[0].metallicFactor = 0.5f; },
        [](Scene& s) { s.materials[0].baseColorFactor.g = 0.5f; },
        [](Scene& s) { s.materials[0].emissiveFactor.b = 0.5f; },
        [](Scene& s) { s.materials[0].unlit = true; },
        [](Scene& s) { s.materials[0].baseColor = {}; },
        [](Scene& s) { s.materials[0].emissive.texture = 0; },
        [](Scene& s) { s.materials[0].baseColor.uvSet = 1; },
        [](Scene& s) { s.materials[0].baseColor.uvTransform[2].x = 0.25f; },
        [](Scene& s) { s.textures[0].wrapS = Wrap::clampToEdge; },
        [](Scene& s) { s.images[0].rgba[400] ^= 1; },
        [](Scene& s) { s.meshes[0].primitives[0].material = -1; },
    };
    std::vector<std::uint64_t> seen{own};
    for (const auto& change : changes) {
        seen.push_back(hash(change));
        EXPECT_EQ(std::ranges::count(seen, seen.back()), 1) << "change " << seen.size() - 1;
    }
}

// The cache does not return a pyramid that was measured with other materials.
TEST(Finish, isPartOfThePyramidsKey) {
    const Scene scene = texturedBall();
    const Finishes finishes(scene);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_NE(pyramidKey(mesh, {}).mesh, pyramidKey(mesh, {.finishes = &finishes}).mesh);
    const Pyramid white = buildPyramid(mesh);
    const Pyramid own = buildPyramid(mesh, {.finishes = &finishes});
    ASSERT_EQ(white.levels.size(), own.levels.size());
    EXPECT_EQ(white.levels[1].positions, own.levels[1].positions) << "levels do not depend on materials";
    EXPECT_NE(white.contrast, own.contrast);
}

}  // namespace
}  // namespace defocus::engine
