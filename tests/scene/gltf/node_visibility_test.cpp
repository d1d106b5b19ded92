// Tests of KHR_node_visibility: a hidden node hides the meshes and lights of its subtree, but not its cameras.

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

}  // namespace
}  // namespace defocus::engine
