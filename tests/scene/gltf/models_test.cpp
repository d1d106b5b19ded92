// Compares loaded public models with the numbers given in their README files and with known properties.

#include "models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "scene/gltf/gltf.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

struct ModelFacts {
    const char* file;
    std::size_t triangles;         // number of triangles if each mesh counts once
    std::size_t trianglesInScene;  // number of triangles if each mesh counts once for every node that draws it
};

class Model : public testing::TestWithParam<ModelFacts> {};

std::size_t trianglesOnce(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.triangleCount();
    return count;
}

void expectConsistent(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        const Vertices& v = mesh.vertices;
        const std::size_t count = v.count();
        for (const std::size_t size : {v.normals.size(), v.tangents.size(), v.uv0.size(), v.uv1.size(), v.colors.size(),
                                       v.joints.size(), v.weights.size()})
            EXPECT_TRUE(size == 0 || size == count) << size << " of " << count;
        for (const Primitive& primitive : mesh.primitives) {
            EXPECT_LT(primitive.material, static_cast<int>(scene.materials.size()));
            for (const std::uint32_t index : primitive.indices) ASSERT_LT(index, count);
        }
        EXPECT_EQ(v.normals.size(), count);
        for (const glm::vec3& normal : v.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
    }
}

TEST_P(Model, hasTheTrianglesOfItsReadme) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam().file);
    const Scene scene = loadGltf(path);
    EXPECT_EQ(trianglesOnce(scene), GetParam().triangles);
    std::size_t inScene = 0;
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0) inScene += scene.meshes[static_cast<std::size_t>(node.mesh)].triangleCount();
    EXPECT_EQ(inScene, GetParam().trianglesInScene);
    expectConsistent(scene);
}

constexpr ModelFacts models[] = {
    {"FlightHelmet/FlightHelmet.gltf", 94722, 94722},
    {"WaterBottle.glb", 4510, 4510},
    {"Suzanne.glb", 3936, 3936},
    {"GlassVaseFlowers.glb", 10218, 14036},
    {"MetalRoughSpheresNoTextures.glb", 1040409, 1040409},
    {"bike.glb", 276540, 276540},
    {"skull.glb", 100002, 100002},
    {"hammer.glb", 60160, 60160},
    {"mountain.glb", 50562, 50562},
    {"nasty/cycloidal.glb", 43368, 43368},
    {"nasty/openscad-nonmanifold-crash.glb", 1442, 1442},
    {"nasty/self_intersectA.glb", 17160, 17160},
    {"nasty/soup.glb", 100, 100},
    {"nasty/wallhole.glb", 66, 66},
    {"BoxAnimated.glb", 254, 254},
    {"InterpolationTest.glb", 110, 110},
    {"Fox.glb", 576, 576},
    {"RiggedFigure.glb", 256, 256},
    {"RecursiveSkeletons.glb", 76, 6384},
    {"AnimatedMorphCube.glb", 12, 12},
    {"AnimatedMorphCube-Quantized.glb", 12, 12},
    {"MorphPrimitivesTest.glb", 32, 32},
    {"suzanne-high-poly-Draco.gltf", 15744, 15744},
    {"japanese-bridge-garden-meshopt.glb", 21883, 21883},
    {"AlphaBlendModeTest.glb", 61, 61},
    {"NegativeScaleTest.glb", 3884, 7724},
    {"MultiUVTest.glb", 12, 12},
    {"TextureTransformTest/TextureTransformTest.gltf", 18, 24},
    {"CornellBox.glb", 36, 36},
    {"TriangleWithoutIndices.gltf", 1, 1},
    {"SimpleSparseAccessor.gltf", 12, 12},
    {"MeshPrimitiveModes.gltf", 16, 16},
    {"SimpleInstancing.glb", 12, 12},
    {"Unicode❤♻Test.glb", 2, 2},
};
INSTANTIATE_TEST_SUITE_P(Readme, Model, testing::ValuesIn(models),
                         [](const auto& tested) { return testNameOf(tested.param.file); });

// The project's own scenes have the triangle counts that their accessors state.
TEST(OwnScenes, haveTheTrianglesTheirAccessorsState) {
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(modelPath("meshes"))) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path());
        ++read;
        std::ifstream file(entry.path(), std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        if (extension == ".glb")
            // keeps only the JSON chunk of the GLB file
            text = text.substr(20, text.find(std::string("BIN\0", 4), 20) - 4 - 20);
        const nlohmann::json json = nlohmann::json::parse(text);
        const Scene scene = loadGltf(entry.path());
        ASSERT_EQ(scene.meshes.size(), json["meshes"].size());
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
            std::size_t corners = 0;
            for (const nlohmann::json& primitive : json["meshes"][m]["primitives"])
                corners += json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
            EXPECT_EQ(scene.meshes[m].triangleCount(), corners / 3) << scene.meshes[m].name;
        }
        expectConsistent(scene);
    }
    EXPECT_GE(read, 12);
}

TEST(Models, pointsAndLinesAreRead) {
    DEFOCUS_MODEL_OR_SKIP(path, "MeshPrimitiveModes.gltf");
    const Scene scene = loadGltf(path);
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_TRUE(scene.meshes.at(0).strokes.at(0).points);
    for (const std::size_t mesh : {1, 2, 3}) EXPECT_FALSE(scene.meshes.at(mesh).strokes.at(0).points);
    EXPECT_EQ(scene.meshes.at(0).strokes[0].indices.size(), 7u);
    EXPECT_EQ(scene.meshes.at(1).strokes[0].indices.size(), 12u);
    EXPECT_EQ(scene.meshes.at(2).strokes[0].indices.size(), 14u);
    EXPECT_EQ(scene.meshes.at(3).strokes[0].indices.size(), 12u);
}

// A quantized cube equals the same cube with float positions, because its node's transform undoes the quantization.
TEST(Models, quantisedCubeEqualsThePlainOne) {
    DEFOCUS_MODEL_OR_SKIP(plainPath, "AnimatedMorphCube.glb");
    DEFOCUS_MODEL_OR_SKIP(quantisedPath, "AnimatedMorphCube-Quantized.glb");
    const Scene plain = loadGltf(plainPath);
    const Scene quantised = loadGltf(quantisedPath);
    const Bounds a = poseAt(plain, 0).bounds;
    const Bounds b = poseAt(quantised, 0).bounds;
    EXPECT_LT(glm::length(a.minimum - b.minimum), 1e-3 * glm::length(a.size()));
    EXPECT_LT(glm::length(a.maximum - b.maximum), 1e-3 * glm::length(a.size()));
    EXPECT_EQ(quantised.meshes.at(0).morphTargets.size(), 2u);
}

TEST(Models, sparsePositionsReplaceTheBase) {
    DEFOCUS_MODEL_OR_SKIP(path, "SimpleSparseAccessor.gltf");
    // The model's description says that vertices 8, 10 and 12 of a strip, 6 wide and 1 high, rise to the heights 2, 3
    // and 4.
    EXPECT_EQ(glm::vec3(loadGltf(path).meshes.at(0).bounds().maximum), glm::vec3(6, 4, 0));
}

TEST(Models, instancesBecomeObjects) {
    DEFOCUS_MODEL_OR_SKIP(path, "SimpleInstancing.glb");
    const Pose pose = poseAt(loadGltf(path), 0);
    ASSERT_EQ(pose.objects.size(), 125u);
    EXPECT_TRUE(pose.objects[124].name.ends_with("#124")) << pose.objects[124].name;
    EXPECT_NE(pose.objects[0].worldFromObject[3], pose.objects[124].worldFromObject[3]);
}

// Each marker of the model shows where the arrow on the texture's diagonal must appear. Every texture transform must
// therefore map the marker to this diagonal (45°).
TEST(Models, textureTransformsLandOnTheModelsMarkers) {
    DEFOCUS_MODEL_OR_SKIP(path, "TextureTransformTest/TextureTransformTest.gltf");
    const Scene scene = loadGltf(path);
    const auto transformed = [&](const char* materialName, const char* marker) {
        const glm::dvec3 at = scene.nodes[static_cast<std::size_t>(nodeNamed(scene, marker))].translation;
        for (const Material& material : scene.materials)
            if (material.name == materialName)
                return material.baseColor.uvTransform * glm::vec3(at.x + 0.5, 0.5 - at.y, 1);
        return glm::vec3(0);
    };
    const glm::vec3 rotated = transformed("Rotation", "Rotation - Correct");
    EXPECT_NEAR(std::atan2(rotated.y, rotated.x), std::numbers::pi / 4, 1e-4);
    const glm::vec3 wrong = transformed("Rotation", "Rotation - Error");
    EXPECT_NEAR(std::atan2(wrong.y, wrong.x), 0, 1e-4);
    const glm::vec3 scaled = transformed("Scale", "Scale - Correct");
    EXPECT_NEAR(scaled.x, 0.7778, 1e-3);
    EXPECT_NEAR(scaled.y, 0.7778, 1e-3);
    const glm::vec3 all = transformed("All", "All - Correct");
    EXPECT_NEAR(all.x, 0.7778, 0.05);  // large tolerance, since the model's author placed this marker by hand
    EXPECT_NEAR(all.y, 0.7778, 0.05);
}

TEST(Models, alphaModesAndDoubleSides) {
    DEFOCUS_MODEL_OR_SKIP(path, "AlphaBlendModeTest.glb");
    const Scene scene = loadGltf(path);
    int masks = 0, blends = 0;
    for (const Material& material : scene.materials) {
        masks += material.alphaMode == AlphaMode::mask ? 1 : 0;
        blends += material.alphaMode == AlphaMode::blend ? 1 : 0;
    }
    EXPECT_EQ(masks, 3);
    EXPECT_EQ(blends, 1);
}

TEST(Models, emissiveStrengthIsMultipliedIn) {
    DEFOCUS_MODEL_OR_SKIP(path, "CornellBox.glb");
    const Scene scene = loadGltf(path);
    float brightest = 0;
    for (const Material& material : scene.materials) brightest = std::max(brightest, material.emissiveFactor.r);
    EXPECT_GT(brightest, 1.0f);
    EXPECT_FALSE(scene.meshes.at(0).vertices.colors.empty());
}

TEST(Models, camerasAndTwoTextureCoordinateSets) {
    DEFOCUS_MODEL_OR_SKIP(path, "MultiUVTest.glb");
    const Scene scene = loadGltf(path);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_FALSE(scene.meshes.at(0).vertices.uv1.empty());
    EXPECT_NE(scene.meshes[0].vertices.uv0, scene.meshes[0].vertices.uv1);
}

TEST(Models, aVaseTransmits) {
    DEFOCUS_MODEL_OR_SKIP(path, "GlassVaseFlowers.glb");
    const Scene scene = loadGltf(path);
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_EQ(scene.extensions.size(), 2u);
    const Material& material = scene.materials.at(2);
    EXPECT_TRUE(material.transmits());
    EXPECT_EQ(material.thicknessFactor, 0.075f);
    EXPECT_TRUE(material.thickness.used());
}

TEST(Models, skinsAndClipsAreKept) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    const Scene scene = loadGltf(path);
    ASSERT_EQ(scene.skins.size(), 1u);
    EXPECT_EQ(scene.skins[0].joints.size(), 24u);
    EXPECT_EQ(scene.skins[0].inverseBindMatrices.size(), 24u);
    EXPECT_EQ(scene.clips.size(), 3u);
    EXPECT_EQ(scene.meshes.at(0).vertices.joints.size(), scene.meshes[0].vertices.count());
    EXPECT_TRUE(scene.ignored.empty());
    for (const glm::vec4& w : scene.meshes[0].vertices.weights) ASSERT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-5f);
}

TEST(Models, clipsHaveTheirThreeInterpolations) {
    DEFOCUS_MODEL_OR_SKIP(path, "InterpolationTest.glb");
    const Scene scene = loadGltf(path);
    EXPECT_EQ(scene.clips.size(), 9u);
    int kinds[3] = {};
    for (const AnimationClip& clip : scene.clips)
        for (const AnimationChannel& channel : clip.channels) ++kinds[static_cast<int>(channel.interpolation)];
    EXPECT_EQ(kinds[0], 3);
    EXPECT_EQ(kinds[1], 3);
    EXPECT_EQ(kinds[2], 3);
}

}  // namespace
}  // namespace defocus::engine
