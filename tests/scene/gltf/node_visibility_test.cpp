// Tests KHR_node_visibility: a hidden node hides the meshes and lights of its subtree, but not its cameras.

#include <gtest/gtest.h>

#include "scene/gltf/builder.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

TEST(GltfNodeVisibility, hidesMeshesAndLightsOfTheSubtree) {
    GltfBuilder builder;
    const int mesh = builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    builder.json["extensionsRequired"] = {"KHR_node_visibility"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    const nlohmann::json light = {{"light", 0}};
    builder.json["nodes"] = {
        {{"mesh", mesh}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}, {"children", {1, 2}}},
        {{"mesh", mesh}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}},
        {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", light}}}},
        {{"mesh", mesh}, {"extensions", {{"KHR_lights_punctual", light}}}}};
    builder.json["nodes"][3]["extensions"]["KHR_node_visibility"] = nlohmann::json::object();
    builder.json["scenes"] = {{{"nodes", {0, 3}}}};
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.objects.size(), 1u);
    EXPECT_EQ(pose.objects[0].node, 3);
    EXPECT_EQ(pose.lights.size(), 1u);
    EXPECT_EQ(pose.cameras.size(), 1u);
}

// Fixture with a node whose visibility is animated by KHR_animation_pointer; keys are unsigned bytes.
class GltfAnimatedVisibility : public testing::Test {
protected:
    GltfAnimatedVisibility() {
        const int mesh = builder_.mesh({{{"attributes", {{"POSITION", builder_.positions(unitTriangle)}}}}});
        builder_.json["extensionsUsed"] = {"KHR_node_visibility", "KHR_animation_pointer", "KHR_lights_punctual"};
        builder_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
        builder_.json["nodes"] = {
            {{"mesh", mesh}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}, {"children", {1}}},
            {{"mesh", mesh}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
            {{"mesh", mesh}}};
        builder_.json["scenes"] = {{{"nodes", {0, 2}}}};
        builder_.json["animations"] = nlohmann::json::parse(R"([{
            "samplers": [{"interpolation": "STEP"}],
            "channels": [{"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer":
                {"pointer": "/nodes/0/extensions/KHR_node_visibility/visible"}}}}]}])");
        nlohmann::json& sampler = builder_.json["animations"][0]["samplers"][0];
        sampler["input"] = builder_.floats({0, 1, 2}, "SCALAR", 1);
        const int keys = builder_.view(std::vector<std::uint8_t>{0, 1, 0});
        sampler["output"] = builder_.accessor(keys, gltfUnsignedByte, "SCALAR", 3);
    }

    static std::vector<int> nodesOf(const Pose& pose) {
        std::vector<int> nodes;
        for (const Object& object : pose.objects) nodes.push_back(object.node);
        return nodes;
    }

    GltfBuilder builder_;
};

TEST_F(GltfAnimatedVisibility, showsTheSubtreeWhileItIsTrue) {
    const Scene scene = builder_.load();
    EXPECT_TRUE(scene.ignored.empty());
    for (const auto& [time, nodes] :
         {std::pair(0.5, std::vector{2}), std::pair(1.5, std::vector{0, 1, 2}), std::pair(2.5, std::vector{2})}) {
        const Pose pose = poseAt(scene, time);
        EXPECT_EQ(nodesOf(pose), nodes) << time;
        ASSERT_EQ(pose.lights.size(), 1u) << time;
        EXPECT_EQ(pose.lights[0].light.intensity > 0, time == 1.5);
    }
    EXPECT_TRUE(poseAt(scene, 1.5, -1).lights.empty());  // without animation
}

TEST_F(GltfAnimatedVisibility, staysThatOfTheExposureWhileTheShutterIsOpen) {
    const Scene scene = builder_.load();
    for (const double exposed : {0.9, 1.1}) {
        const Pose pose = poseAt(scene, exposed);
        for (const double time : {0.8, 1.2}) EXPECT_EQ(nodesOf(shutterPoseAt(scene, time, 0, pose)), nodesOf(pose));
    }
}

}  // namespace
}  // namespace defocus::engine
