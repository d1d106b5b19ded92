// Tests that each edit of the request either updates the world or is reverted.

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/ground.h"
#include "view/document/document.h"

namespace defocus::engine {
namespace {

class WorldUpdate : public testing::Test {
protected:
    void SetUp() override {
        state.options.fishCount = 3;
        state.options.trianglesPerFish = 200;
        state.options.noCache = true;
        document.frame = std::make_unique<PreparedFrame>(prepareFrame(state.options));
        document.shown = state.options;
        document.ownBlurs.assign(document.frame->scene->nodes.size(), 1);
        state.lens = document.frame->view.lens;
        state.pictureSize = {64, 48};
    }
    void update(bool held = false) { updateWorld(document, state, held); }
    [[nodiscard]] const std::vector<Object>& objects() const { return document.frame->world.pose.objects; }
    [[nodiscard]] std::string nameOf(int object) const { return objects()[static_cast<std::size_t>(object)].name; }

    Document document;
    ViewState state;
};

TEST_F(WorldUpdate, withoutAnEditChangesNothing) {
    update();
    EXPECT_EQ(document.poseVersion, 0u);
    EXPECT_EQ(document.worldVersion, 0u);
}

TEST_F(WorldUpdate, hiddenNodesLeaveThePoseAndTheSelectionStays) {
    const std::size_t all = objects().size();
    ASSERT_GE(all, 2u);
    const std::string first = nameOf(0);
    const std::string last = objects().back().name;
    state.selected = static_cast<int>(all) - 1;
    state.options.hide = {first};
    update();
    EXPECT_EQ(objects().size(), all - 1);
    EXPECT_EQ(nameOf(state.selected), last);
    EXPECT_GT(document.poseVersion, 0u);
    state.options.hide = {last};
    update();
    EXPECT_EQ(state.selected, -1);
    state.options.hide.clear();
    update();
    EXPECT_EQ(objects().size(), all);
}

TEST_F(WorldUpdate, aGroundWaitsForThePyramids) {
    document.draft = true;
    state.options.ground = true;
    update();
    EXPECT_FALSE(hasGround(*document.frame->scene));
    document.draft = false;
    update();
    EXPECT_TRUE(hasGround(*document.frame->scene));
    EXPECT_EQ(document.frame->world.pyramids.size(), document.frame->scene->meshes.size());
    EXPECT_EQ(document.worldVersion, 1u);
    state.options.ground = false;
    update();
    EXPECT_FALSE(hasGround(*document.frame->scene));
    EXPECT_EQ(document.frame->world.pyramids.size(), document.frame->scene->meshes.size());
}

TEST_F(WorldUpdate, surroundingsWaitForTheHandAndBadOnesAreReverted) {
    state.options.environment = "studio";
    update(true);
    EXPECT_EQ(document.worldVersion, 0u);
    update();
    EXPECT_EQ(document.worldVersion, 1u);
    EXPECT_EQ(document.frame->world.environment.type, EnvironmentType::map);
    state.options.environment = "absent.hdr";
    update();
    EXPECT_EQ(document.worldVersion, 1u);
    EXPECT_EQ(state.options.environment, "studio");
    EXPECT_NE(state.fault.find("absent.hdr"), std::string::npos) << state.fault;
}

TEST_F(WorldUpdate, nodesGetTheirOwnBlurBack) {
    const std::string name = document.frame->scene->nodes[static_cast<std::size_t>(objects()[0].node)].name;
    const auto scaleOf = [&] { return objects()[0].cocScale; };
    ASSERT_EQ(scaleOf(), 1);
    state.options.nodeBlur[name] = 0.25;
    update();
    EXPECT_EQ(scaleOf(), 0.25);
    state.options.nodeBlur.clear();
    update();
    EXPECT_EQ(scaleOf(), 1);
}

TEST_F(WorldUpdate, lightsGetTheirSize) {
    state.options.lightAngle = 9;
    update();
    const auto wide = [](const PlacedLight& placed) { return placed.light.angularDiameter > 0.15f; };
    EXPECT_TRUE(std::ranges::all_of(document.frame->world.lights, wide));
    EXPECT_EQ(document.poseVersion, 1u);
    EXPECT_EQ(document.worldVersion, 0u);
}

}  // namespace
}  // namespace defocus::engine
