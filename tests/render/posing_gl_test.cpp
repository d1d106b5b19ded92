// Tests skins and morph targets on the GPU against static meshes, posed by the CPU for the same time.

#include <gtest/gtest.h>

#include "gl_context_test.h"
#include "image/metrics.h"
#include "models.h"
#include "posed_world.h"
#include "render/aov/aov.h"
#include "render/methods.h"
#include "render/rendered.h"

namespace defocus::engine {
namespace {

using Posing = GlContextTest;

Image renderedInHalf(const SmallWorld& small, const RenderSettings& settings, const char* method = "accumulation") {
    const RendererOptions options{.layerFormat = LayerFormat::rgba16f};
    const auto renderer = methodNamed(method).make(small.world, options);
    return imageOf(*renderer, planFrame(small.world, small.view, settings));
}

RenderSettings levelZeroSettings() {
    return {.sampleCount = 4, .lod = LodMode::off};
}

// Expects the images of GPU-posed and CPU-posed (`baked`) meshes to be equal up to rounding. Single precision rounds
// differently, so pixels may differ where an edge passes close to a sample.
void expectSamePicture(const Image& posed, const Image& baked, const std::string& what) {
    const Difference difference = compareImages(baked, posed);
    EXPECT_EQ(difference.nonFinite, 0u) << what;
    EXPECT_GT(difference.psnr, 55) << what;
}

class PosingOf : public Posing, public testing::WithParamInterface<PosedModel> {};

TEST_P(PosingOf, equalsTheBakedMeshes) {
    const auto& [file, clip] = GetParam();
    DEFOCUS_MODEL_OR_SKIP(path, file);
    for (const double time : {0.0, 0.4, 1.1}) {
        const auto posed = posedWorld(path, time, clip);
        expectSamePicture(renderedInHalf(*posed, levelZeroSettings()),
                          renderedInHalf(*bakedWorld(*posed, 0), levelZeroSettings()), std::to_string(time) + " s");
    }
}

INSTANTIATE_TEST_SUITE_P(Models, PosingOf, testing::ValuesIn(posedModels), posedModelName);

// Coarse levels of detail are also posed: an unlit figure's coarsest level equals the same level posed on the CPU.
TEST_F(Posing, coarseLevelsArePosedToo) {
    for (const char* file : {"meshes/reed.glb", "Fox.glb", "RiggedFigure.glb"}) {
        const auto posed = posedWorld(modelPath(file), 0.4, 0);
        for (Material& material : posed->scene.materials) material.unlit = true;
        ASSERT_GT(posed->world.pyramids[0].levels.size(), 2u);
        RenderSettings coarse = levelZeroSettings();
        coarse.lod = LodMode::nearest;
        coarse.thresholds = {0, 1e6};
        const FramePlan plan = planFrame(posed->world, posed->view, coarse);
        ASSERT_EQ(plan.objects.at(0).fine.level, posed->world.pyramids[0].levels.size() - 1);
        const Image image = renderedInHalf(*posed, coarse);
        expectSamePicture(image, renderedInHalf(*bakedWorld(*posed, 99), levelZeroSettings()), file);
        EXPECT_LT(compareImages(renderedInHalf(*posed, levelZeroSettings()), image).psnr, 50) << file;
    }
}

// A skin with eight joints per vertex combines with morph targets that have normals. One of the joints is missing from
// the skin.
TEST_F(Posing, eightInfluencesAndMorphsTogether) {
    SmallWorld small;
    const Material plain{.metallicFactor = 0};
    small.scene.materials.push_back(plain);
    small.scene.meshes.push_back(bumpySphere(60, 40, 0));
    Mesh& mesh = small.scene.meshes[0];
    MorphTarget target;
    for (const glm::vec3& p : mesh.vertices.positions) {
        mesh.vertices.joints.push_back({0, 1, 2, 3});
        mesh.vertices.joints1.push_back({4, 5, 60, 7});
        const float x = 0.5f + 0.5f * p.x;
        const float y = 0.5f + 0.5f * p.y;
        mesh.vertices.weights.push_back(glm::vec4(x, y, 1 - x, 1 - y) / 4.0f);
        mesh.vertices.weights1.push_back(glm::vec4(x * y, x - x * y, y - x * y, 1 - x - y + x * y) / 2.0f);
        target.positions.push_back(0.4f * glm::vec3(p.y * p.y, 0, p.x));
        target.normals.push_back(0.3f * glm::vec3(p.y, 0, 0));
    }
    mesh.morphTargets = {MorphTarget{}, target, target};
    place(small, 0, glm::dmat4(1));
    Object& object = small.world.pose.objects[0];
    for (int j = 0; j < 8; ++j)
        object.worldFromJoint.push_back(
            glm::translate(glm::dmat4(1), glm::dvec3(0.1 * j - 0.4, 0.03 * j * j - 0.6, -4)) *
            glm::rotate(glm::dmat4(1), 0.2 * j, glm::normalize(glm::dvec3(1, j, 2))));
    object.worldFromObject = object.worldFromJoint.front();
    object.morphWeights = {0.7, 0.8, -0.2};
    addSun(small);
    small.world.environment = {EnvironmentType::uniform, {0.2f, 0.2f, 0.2f}, {}, {}, nullptr, true, 1};
    small.view.width = 128;
    small.view.height = 96;
    small.view.lens.focusDistance = 4;
    finish(small);
    const auto baked = bakedWorld(small, 0);
    const Image image = renderedInHalf(small, levelZeroSettings());
    expectSamePicture(image, renderedInHalf(*baked, levelZeroSettings()), "accumulation");
    expectSamePicture(renderedInHalf(small, levelZeroSettings(), "circular"),
                      renderedInHalf(*baked, levelZeroSettings(), "circular"), "circular");
    object.morphWeights = {0, 0, 0};
    EXPECT_LT(compareImages(renderedInHalf(small, levelZeroSettings()), image).psnr, 40);
}

void expectDepthsOfThePosedSurface(const std::filesystem::path& path, int clip) {
    const auto posed = posedWorld(path, 0.4, clip);
    const auto baked = bakedWorld(*posed, 0);
    const AovImages a = renderAovs(posed->world, planFrame(posed->world, posed->view, levelZeroSettings()), {});
    const AovImages b = renderAovs(baked->world, planFrame(baked->world, baked->view, levelZeroSettings()), {});
    int differing = 0;
    int covered = 0;
    for (std::size_t i = 0; i < a.depth.pixels.size(); ++i) {
        covered += std::isfinite(a.depth.pixels[i]) ? 1 : 0;
        const bool same = a.depth.pixels[i] == b.depth.pixels[i] ||
                          std::abs(a.depth.pixels[i] - b.depth.pixels[i]) < 1e-4f * b.depth.pixels[i];
        differing += same ? 0 : 1;
    }
    EXPECT_GT(covered, 500);
    EXPECT_LE(differing, 5);
}

TEST_F(Posing, depthsAreThoseOfThePosedSurface) {
    expectDepthsOfThePosedSurface(modelPath("meshes/reed.glb"), 0);
}

TEST_F(Posing, depthsAreThoseOfTheWalkingFox) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    expectDepthsOfThePosedSurface(path, 1);
}

// A wall with a normal map looks the same whether a joint, a morph target or its own matrix rotates it.
TEST_F(Posing, tangentsTurnToo) {
    const auto wall = [] {
        auto small = std::make_unique<SmallWorld>();
        Material bumpy{.metallicFactor = 0};
        bumpy.normal.texture = 0;
        small->scene.materials.push_back(bumpy);
        Texture& texture = small->scene.textures.emplace_back();
        texture.image = 0;
        TextureImage& image = small->scene.images.emplace_back();
        image.width = image.height = 2;
        image.rgba = {255, 128, 128, 255, 128, 128, 255, 255, 128, 128, 255, 255, 128, 200, 200, 255};
        small->scene.meshes.push_back(quad(0));
        Vertices& vertices = small->scene.meshes[0].vertices;
        vertices.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        vertices.tangents.assign(4, {1, 0, 0, 1});
        small->world.lights = {sunFrom({-0.8, -0.5, -1}, 1)};
        small->world.environment = {EnvironmentType::uniform, {0.1f, 0.1f, 0.1f}, {}, {}, nullptr, true, 1};
        small->view.width = 96;
        small->view.height = 64;
        return small;
    };
    const glm::dmat4 inFront = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4));
    const glm::dmat4 turn = glm::rotate(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(0, 1, 0)), 1.3, glm::dvec3(0, 0, 1));
    auto placed = wall();
    place(*placed, 0, inFront * turn);
    finish(*placed);
    const Image expected = renderedInHalf(*placed, levelZeroSettings());

    auto skinned = wall();
    skinned->scene.meshes[0].vertices.joints.assign(4, {1, 0, 0, 0});
    skinned->scene.meshes[0].vertices.weights.assign(4, {1, 0, 0, 0});
    place(*skinned, 0, glm::dmat4(1));
    skinned->world.pose.objects[0].worldFromJoint = {glm::dmat4(1), inFront * turn};
    finish(*skinned);
    expectSamePicture(renderedInHalf(*skinned, levelZeroSettings()), expected, "skin");

    auto morphed = wall();
    Mesh& mesh = morphed->scene.meshes[0];
    const glm::mat3 turned(turn);
    MorphTarget target;
    for (std::size_t v = 0; v < 4; ++v) {
        const glm::vec3 tangent(mesh.vertices.tangents[v]);
        target.positions.push_back(turned * mesh.vertices.positions[v] - mesh.vertices.positions[v]);
        target.normals.push_back(turned * mesh.vertices.normals[v] - mesh.vertices.normals[v]);
        target.tangents.push_back(turned * tangent - tangent);
    }
    mesh.morphTargets = {target};
    place(*morphed, 0, inFront);
    morphed->world.pose.objects[0].morphWeights = {1};
    finish(*morphed);
    expectSamePicture(renderedInHalf(*morphed, levelZeroSettings()), expected, "morph");
    morphed->scene.meshes[0].morphTargets[0].tangents.clear();
    EXPECT_LT(compareImages(expected, renderedInHalf(*morphed, levelZeroSettings())).psnr, 45);
}

}  // namespace
}  // namespace defocus::engine
