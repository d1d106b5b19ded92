#include "scene/hidden_nodes.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace defocus::engine {
namespace {

// Returns a scene with a table at x = 10 m, its child node "cup" at 30 m, and two nodes named "lamp" at 30 m and 40 m.
Scene furnishedScene() {
    Scene scene;
    Mesh mesh;
    mesh.vertices.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.primitives = {{-1, {0, 1, 2}}};
    scene.meshes = {mesh};
    scene.nodes.resize(4);
    const char* const names[] = {"table", "cup", "lamp", "lamp"};
    for (std::size_t i = 0; i < 4; ++i) {
        scene.nodes[i].name = names[i];
        scene.nodes[i].mesh = 0;
        scene.nodes[i].translation = {10.0 * (static_cast<double>(i) + 1), 0, 0};
    }
    scene.nodes[0].children = {1};
    scene.nodes[1].parent = 0;
    scene.roots = {0, 2, 3};
    return scene;
}

std::vector<int> shownNodes(const Scene& scene, const std::vector<std::string>& hidden) {
    Pose pose = poseAt(scene, 0, -1);
    hideNodes(scene, hidden, pose);
    std::vector<int> nodes;
    for (const Object& object : pose.objects) nodes.push_back(object.node);
    return nodes;
}

TEST(HiddenNodes, takeWithThemWhatIsBelow) {
    const Scene scene = furnishedScene();
    EXPECT_EQ(shownNodes(scene, {}), (std::vector{0, 1, 2, 3}));
    EXPECT_EQ(shownNodes(scene, {"table"}), (std::vector{2, 3}));
    EXPECT_EQ(shownNodes(scene, {"cup"}), (std::vector{0, 2, 3}));
    EXPECT_EQ(shownNodes(scene, {"3", "cup"}), (std::vector{0, 2}));
    // a name hides only the first node of that name; the second node "lamp" stays visible
    EXPECT_EQ(shownNodes(scene, {"lamp"}), (std::vector{0, 1, 3}));
}

TEST(HiddenNodes, boundsAreOfWhatIsLeft) {
    const Scene scene = furnishedScene();
    Pose pose = poseAt(scene, 0, -1);
    EXPECT_DOUBLE_EQ(pose.bounds.maximum.x, 41);
    hideNodes(scene, std::vector<std::string>{"3"}, pose);
    EXPECT_DOUBLE_EQ(pose.bounds.minimum.x, 10);
    EXPECT_DOUBLE_EQ(pose.bounds.maximum.x, 31);  // the cup and the first lamp extend from x = 30 to 31 m
}

TEST(HiddenNodes, callingsAreReadBackAsTheirNodes) {
    Scene scene = furnishedScene();
    scene.nodes[1].name = "2";  // a name that equals another node's index
    for (int node = 0; node < 4; ++node) EXPECT_EQ(nodeCalled(scene, callingOf(scene, node)), node) << node;
    EXPECT_EQ(callingOf(scene, 0), "table");
    EXPECT_EQ(callingOf(scene, 2), "#2");
    EXPECT_EQ(callingOf(scene, 3), "3");
}

TEST(HiddenNodes, unknownNamesAreFaults) {
    const Scene scene = furnishedScene();
    Pose pose = poseAt(scene, 0, -1);
    for (const char* name : {"chair", "4", "-1", ""})
        EXPECT_THROW(hideNodes(scene, std::vector<std::string>{name}, pose), Error) << name;
}

}  // namespace
}  // namespace defocus::engine
