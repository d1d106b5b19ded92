// Tests that files with very many elements of one kind load correctly and fast; quadratic time would exceed the tests'
// time limit. Also tests that the memory budget counts shared data once for each node that uses it.

#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "models.h"
#include "scene/gltf/builder.h"
#include "scene/gltf/source.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

std::string faultOf(const GltfBuilder& builder) {
    return messageOf<Error>([&] { (void)builder.load(); });
}

TEST(LargeGltf, rootsCountOnceHoweverOftenTheyAreListed) {
    constexpr int count = 500'000;
    GltfBuilder builder;
    nlohmann::json::array_t nodes(count, nlohmann::json::object());
    nlohmann::json::array_t listed;
    for (int i = 0; i < count; ++i) listed.insert(listed.end(), 2, count - 1 - i);
    builder.json["nodes"] = std::move(nodes);
    builder.json["scenes"] = {{{"nodes", std::move(listed)}}};
    const Scene scene = builder.load();
    std::vector<int> expected(count);
    std::iota(expected.rbegin(), expected.rend(), 0);
    EXPECT_EQ(scene.roots, expected);
}

TEST(LargeGltf, extensionsAreAllNamed) {
    constexpr int count = 300'000;
    GltfBuilder builder;
    builder.json["extensionsUsed"] = nlohmann::json::array();
    for (int i = 0; i < count; ++i) builder.json["extensionsUsed"].push_back(fmt::format("EXT_{:06}", i % (count / 2)));
    const Scene scene = builder.load();
    ASSERT_EQ(scene.ignored.size(), count / 2u);
    EXPECT_EQ(scene.ignored.front().what, "extension EXT_000000");
    EXPECT_EQ(scene.ignored.back().what, "extension EXT_149999");
    EXPECT_EQ(scene.ignored.back().count, 1u);
}

TEST(LargeGltf, primitivesShareVerticesByTheirAttributes) {
    constexpr int sets = 50'000;
    GltfBuilder builder;
    const int view = builder.view(unitTriangle);
    nlohmann::json primitives;
    for (int i = 0; i < 2 * sets; ++i) {
        if (i < sets) builder.accessor(view, gltfFloat, "VEC3", 3);
        primitives.push_back({{"attributes", {{"POSITION", i % sets}, {"NORMAL", i % sets}}}});
    }
    builder.mesh(primitives);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.meshes.at(0).primitives.size(), 2u * sets);
    EXPECT_EQ(scene.meshes[0].vertices.count(), 3u * sets);
    EXPECT_EQ(scene.meshes[0].primitives[1].indices, scene.meshes[0].primitives[sets + 1].indices);
}

TEST(LargeGltf, chainsOfNodesPassTheirBlurOn) {
    constexpr int count = 200'000;
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    nlohmann::json::array_t nodes;
    for (int i = 0; i < count; ++i) nodes.push_back({{"mesh", 0}, {"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    nodes[1]["extras"]["cocScale"] = 0.5;
    nodes[count / 2]["extras"]["cocScale"] = 4;
    builder.json["nodes"] = std::move(nodes);
    const Pose pose = unmeasuredPoseAt(builder.load(), 0);
    ASSERT_EQ(pose.objects.size(), count + 1u);
    EXPECT_EQ(pose.objects[0].cocScale, 1);
    EXPECT_EQ(pose.objects[1].cocScale, 0.5);
    EXPECT_EQ(pose.objects[count / 2 - 1].cocScale, 0.5);
    EXPECT_EQ(pose.objects[count / 2].cocScale, 2);
    EXPECT_EQ(pose.objects[count].cocScale, 2);
}

TEST(UnpackBudget, isOneForAll) {
    gltf::UnpackBudget budget;
    EXPECT_TRUE(budget.take(300, 1 << 20));
    EXPECT_FALSE(budget.take(300, 1 << 20));
    EXPECT_FALSE(budget.take(std::uint64_t{1} << 40, std::uint64_t{1} << 40)) << "the product overflows";
    budget.grant(1 << 20);
    EXPECT_TRUE(budget.take(300, 1 << 20));
    EXPECT_EQ(budget.fileBytes(), 1u << 20);
}

TEST(UnpackBudget, instancesAreObjects) {
    GltfBuilder builder;
    const int places = builder.accessor(-1, gltfFloat, "VEC3", 400'000);
    builder.mesh(
        {{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}},
        {{"name", "Herd"}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    EXPECT_NE(faultOf(builder).find("objects of node 'Herd': 400000 elements would expand a file of"),
              std::string::npos)
        << faultOf(builder);
}

TEST(UnpackBudget, skinsTakeTheirJointsForEachNode) {
    constexpr int count = 3'000;
    GltfBuilder builder;
    const int joints = builder.accessor(builder.view(std::vector<std::uint8_t>(12)), gltfUnsignedByte, "VEC4", 3);
    const int weights = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    builder.mesh({{{"attributes",
                    {{"POSITION", builder.positions(unitTriangle)}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}}},
                 {{"skin", 0}});
    for (int i = 1; i < count; ++i) builder.add("nodes", builder.json["nodes"][0]);
    nlohmann::json all;
    for (int i = 0; i < count; ++i) all.push_back(i);
    builder.json["skins"] = {{{"joints", all}}};
    const std::string fault = faultOf(builder);
    EXPECT_NE(fault.find("joints of node '': 3000 elements would expand"), std::string::npos) << fault;
    // The message gives the memory of the matrices of all nodes, not of the 3,000 matrices of the last node.
    const std::size_t number = fault.find(" bytes to ") + std::string_view(" bytes to ").size();
    EXPECT_GT(std::stod(fault.substr(number)), 512) << fault;
}

TEST(UnpackBudget, morphWeightsAreOfEachNode) {
    constexpr int count = 6'000;
    GltfBuilder builder;
    nlohmann::json::array_t targets(count, nlohmann::json::object());
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}, {"targets", std::move(targets)}}});
    for (int i = 1; i < count; ++i) builder.add("nodes", {{"mesh", 0}});
    EXPECT_NE(faultOf(builder).find("morph weights of node '': 6000 elements would expand"), std::string::npos)
        << faultOf(builder);
}

}  // namespace
}  // namespace defocus::engine
