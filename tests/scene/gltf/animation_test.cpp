// Tests clips, skins, and animated cameras and lights. The tests write small files and load them.

#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "scene/defaults.h"
#include "scene/gltf/builder.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

json attributesOf(GltfBuilder& builder) {
    return {{"POSITION", builder.positions(unitTriangle)}};
}

// Adds a channel whose sampler interpolates from the first to the last of `values` in two seconds.
int addChannel(GltfBuilder& builder, json& animation, const std::vector<float>& values, const char* type,
               const json& target) {
    const std::size_t components = values.size() / 2;
    const int times = builder.floats({0, 2}, "SCALAR", 1);
    const int output = builder.floats(values, type, components);
    animation["samplers"].push_back({{"input", times}, {"output", output}});
    const int sampler = static_cast<int>(animation["samplers"].size()) - 1;
    animation["channels"].push_back({{"sampler", sampler}, {"target", target}});
    return sampler;
}

json pointer(const char* path) {
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", path}}}}}};
}

TEST(GltfSkin, eightInfluencesAreReadAndSumToOne) {
    GltfBuilder builder;
    json attributes = attributesOf(builder);
    const std::vector<std::uint8_t> first(12, 1), further(12, 2);
    attributes["JOINTS_0"] = builder.accessor(builder.view(first), gltfUnsignedByte, "VEC4", 3);
    attributes["JOINTS_1"] = builder.accessor(builder.view(further), gltfUnsignedByte, "VEC4", 3);
    attributes["WEIGHTS_0"] = builder.floats({1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
    attributes["WEIGHTS_1"] = builder.floats({1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
    builder.mesh({{{"attributes", attributes}}}, {{"skin", 0}});
    for (int i = 0; i < 3; ++i) builder.add("nodes", json::object());
    builder.json["skins"] = {{{"joints", {1, 2, 3}}}};
    const Scene scene = builder.load();
    const Vertices& vertices = scene.meshes[0].vertices;
    EXPECT_EQ(vertices.weights[0], glm::vec4(0.5f, 0, 0, 0));
    EXPECT_EQ(vertices.weights1[0], glm::vec4(0.5f, 0, 0, 0));
    EXPECT_EQ(vertices.weights1[1], glm::vec4(0.25f, 0.25f, 0, 0));
    EXPECT_EQ(vertices.weights[2], glm::vec4(1, 0, 0, 0));  // without weights, the vertex follows its first joint
    EXPECT_EQ(vertices.joints1[0], glm::u16vec4(2));
    EXPECT_TRUE(scene.ignored.empty());
    // If a skin has no inverseBindMatrices, all matrices are the identity.
    EXPECT_EQ(scene.skins[0].inverseBindMatrices, std::vector<glm::mat4>(3, glm::mat4(1)));
}

TEST(GltfSkin, furtherInfluencesOutOfRangeAreRefused) {
    GltfBuilder builder;
    json attributes = attributesOf(builder);
    const std::vector<std::uint8_t> first(12, 0), further(12, 9);
    attributes["JOINTS_0"] = builder.accessor(builder.view(first), gltfUnsignedByte, "VEC4", 3);
    attributes["JOINTS_1"] = builder.accessor(builder.view(further), gltfUnsignedByte, "VEC4", 3);
    const int weights = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    attributes["WEIGHTS_0"] = attributes["WEIGHTS_1"] = weights;
    builder.mesh({{{"attributes", attributes}}}, {{"skin", 0}});
    builder.json["skins"] = {{{"joints", {0}}}};
    EXPECT_THROW((void)builder.load(), Error);
}

// If a mesh has no normals, its flat normals follow a morph target. Here the target lifts one corner of a triangle.
TEST(GltfMorph, flatNormalsFollowTheirTarget) {
    GltfBuilder builder;
    // The target moves the corner (1, 0, 0) to (1, 0, 1).
    const int target = builder.positions({0, 0, 0, 0, 0, 1, 0, 0, 0});
    builder.mesh({{{"attributes", attributesOf(builder)}, {"targets", {{{"POSITION", target}}}}}});
    const Mesh mesh = builder.load().meshes[0];
    ASSERT_EQ(mesh.morphTargets.at(0).normals.size(), 3u);
    const glm::vec3 lifted = mesh.vertices.normals[0] + mesh.morphTargets[0].normals[0];
    EXPECT_LT(glm::length(lifted - glm::normalize(glm::vec3(-1, 0, 1))), 1e-6f);
}

// Tangent offsets of morph targets have three components; the handedness of the tangents stays constant.
TEST(GltfMorph, tangentsAndNormalsAreRead) {
    GltfBuilder builder;
    json attributes = attributesOf(builder);
    attributes["NORMAL"] = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    attributes["TANGENT"] = builder.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
    const json target = {{"TANGENT", builder.floats({0, 1, 0, 0, 2, 0, 0, 3, 0}, "VEC3", 3)},
                         {"NORMAL", builder.floats({4, 0, 0, 5, 0, 0, 6, 0, 0}, "VEC3", 3)}};
    builder.mesh({{{"attributes", attributes}, {"targets", {target}}}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.meshes[0].morphTargets.size(), 1u);
    const MorphTarget& morph = scene.meshes[0].morphTargets[0];
    EXPECT_EQ(morph.tangents, (std::vector<glm::vec3>{{0, 1, 0}, {0, 2, 0}, {0, 3, 0}}));
    EXPECT_EQ(morph.normals, (std::vector<glm::vec3>{{4, 0, 0}, {5, 0, 0}, {6, 0, 0}}));
    EXPECT_TRUE(scene.ignored.empty());
}

TEST(GltfMorph, animatedWeightsReachTheObject) {
    GltfBuilder builder;
    const int target = builder.positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    builder.mesh(
        {{{"attributes", attributesOf(builder)}, {"targets", {{{"POSITION", target}}, {{"POSITION", target}}}}}});
    builder.json["meshes"][0]["weights"] = {0.25, 0.5};
    json animation;
    const int times = builder.floats({0, 2}, "SCALAR", 1);
    const int output = builder.floats({0, 1, 1, 0}, "SCALAR", 1);
    animation["samplers"] = {{{"input", times}, {"output", output}}};
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}};
    builder.json["animations"] = {animation};
    const Scene scene = builder.load();
    EXPECT_EQ(poseAt(scene, 0, -1).objects[0].morphWeights, (std::vector<double>{0.25, 0.5}));
    EXPECT_EQ(poseAt(scene, 0.5).objects[0].morphWeights, (std::vector<double>{0.25, 0.75}));
    EXPECT_EQ(poseAt(scene, 9).objects[0].morphWeights, (std::vector<double>{1, 0}));
    EXPECT_DOUBLE_EQ(poseAt(scene, 0.5).bounds.maximum.z, 1);
}

TEST(GltfAnimation, camerasMoveWithTheirNodes) {
    GltfBuilder builder;
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.add("nodes", {{"camera", 0}});
    json animation;
    addChannel(builder, animation, {0, 0, 0, 4, 0, 0}, "VEC3", {{"node", 0}, {"path", "translation"}});
    builder.json["animations"] = {animation};
    const Scene scene = builder.load();
    const PlacedCamera camera = chooseCamera(scene, poseAt(scene, 0.5), {}, 1);
    EXPECT_DOUBLE_EQ(camera.worldFromCamera[3].x, 1);
    EXPECT_DOUBLE_EQ(worldFromCameraIn(camera, poseAt(scene, 1))[3].x, 2);
}

TEST(GltfAnimation, pointersDriveCamerasLightsAndNodes) {
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual"};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 5}}};
    builder.add("nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    json animation;
    addChannel(builder, animation, {0.4f, 0.8f}, "SCALAR", pointer("/cameras/0/perspective/yfov"));
    addChannel(builder, animation, {1, 3}, "SCALAR", pointer("/cameras/0/extras/focusDistance"));
    addChannel(builder, animation, {10, 20}, "SCALAR", pointer("/extensions/KHR_lights_punctual/lights/0/intensity"));
    addChannel(builder, animation, {0, 0, 0, 1, 0.5f, 0}, "VEC3",
               pointer("/extensions/KHR_lights_punctual/lights/0/color"));
    addChannel(builder, animation, {0, 0, 0, 0, 8, 0}, "VEC3", pointer("/nodes/0/translation"));
    addChannel(builder, animation, {0, 1}, "SCALAR", pointer("/materials/0/alphaCutoff"));
    builder.json["animations"] = {animation};
    const Scene scene = builder.load();
    const Pose pose = poseAt(scene, 1);
    EXPECT_NEAR(chooseCamera(scene, pose, {}, 1).camera.yfov, 0.6, 1e-6);
    EXPECT_NEAR(chooseCamera(scene, pose, {}, 1).camera.lensValue("focusDistance").value(), 2, 1e-6);
    EXPECT_FLOAT_EQ(pose.lights.at(0).light.intensity, 15);
    EXPECT_FLOAT_EQ(pose.lights[0].light.color.r, 0.5f);
    EXPECT_DOUBLE_EQ(pose.lights[0].position.y, 4);
    // the channel is ignored, since materials are not animated
    EXPECT_EQ(scene.ignored.at(0).what, "animation channel");
    EXPECT_EQ(scene.cameras[0].yfov, 0.5);  // the camera keeps the value in the file
}

TEST(GltfAnimation, pointersToWhatIsMissingAreRefused) {
    for (const char* path : {"/cameras/3/perspective/yfov", "/nodes/77/scale"}) {
        GltfBuilder builder;
        builder.mesh({{{"attributes", attributesOf(builder)}}});
        json animation;
        addChannel(builder, animation, {0, 1}, "SCALAR", pointer(path));
        builder.json["animations"] = {animation};
        EXPECT_THROW((void)builder.load(), Error) << path;
    }
}

TEST(Clips, areFoundByNameAndNumber) {
    Scene scene;
    scene.clips.resize(3);
    scene.clips[0].name = "Survey";
    scene.clips[1].name = "2";
    EXPECT_EQ(clipNamed(scene, "Survey"), 0);
    EXPECT_EQ(clipNamed(scene, "2"), 1);  // the clip that is named "2" takes precedence over the clip with index 2
    EXPECT_EQ(clipNamed(scene, "1"), 1);
    for (const char* wrong : {"3", "-1", "1.0", "", "Walk"})
        EXPECT_THROW((void)clipNamed(scene, wrong), Error) << wrong;
}

TEST(Clips, loopInBothDirections) {
    AnimationClip clip;
    clip.duration = 2;
    EXPECT_DOUBLE_EQ(loopedTime(clip, 0.5), 0.5);
    EXPECT_DOUBLE_EQ(loopedTime(clip, 2), 0);
    EXPECT_DOUBLE_EQ(loopedTime(clip, 7.25), 1.25);
    EXPECT_DOUBLE_EQ(loopedTime(clip, -0.5), 1.5);
    clip.duration = 0;
    EXPECT_EQ(loopedTime(clip, 3), 0);
}

}  // namespace
}  // namespace defocus::engine
