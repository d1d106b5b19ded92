#include "capture/frame_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "capture/capture.h"
#include "capture/shot_json.h"
#include "capture/shot_options.h"
#include "core/error.h"

namespace defocus::engine {
namespace {

// Fixture with a scene of two nodes without meshes: "Still" at (0, 0, −4), and "Rising", which rises at 1 m/s for 2 s.
// The camera looks along −z from the origin.
class FrameSequence : public testing::Test {
protected:
    FrameSequence() {
        Node still;
        still.name = "Still";
        still.translation = {0, 0, -4};
        Node rising;
        rising.name = "Rising";
        rising.translation = {0, 0, -2};
        Node tripod;
        tripod.name = "Tripod";
        tripod.camera = 0;
        scene_.nodes = {still, rising, tripod};
        scene_.roots = {0, 1, 2};
        scene_.cameras.emplace_back().name = "Main";
        AnimationChannel climb;
        climb.target = 1;
        climb.times = {0, 2};
        climb.values = {0, 0, -2, 0, 2, -2};
        scene_.clips.push_back({"Climb", {climb}, 2});
        base_.scene = owned_;
        base_.fixedLens = {"focalLength"};
    }

    [[nodiscard]] FrameMoment frame(const char* shot, int number) const {
        return frameAt(parseShot(shot, "x.json"), base_, number);
    }
    [[nodiscard]] static glm::dvec3 placeOf(const FrameMoment& frame) { return frame.view.worldFromCamera[3]; }
    [[nodiscard]] static glm::dvec3 forwardOf(const FrameMoment& frame) {
        return -glm::dvec3(frame.view.worldFromCamera[2]);
    }
    static void expectNear(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); }

    std::shared_ptr<Scene> owned_ = std::make_shared<Scene>();
    Scene& scene_ = *owned_;
    SequenceBase base_;
};

TEST_F(FrameSequence, timeFollowsRateStartSpeedAndLoop) {
    EXPECT_EQ(frame(R"({"frameRate": 10})", 5).time, 0.5);
    EXPECT_EQ(frame(R"({"frameRate": 10, "animation": {"start": 1, "speed": 2}})", 5).time, 2);
    EXPECT_DOUBLE_EQ(frame(R"({"frameRate": 10, "animation": {"loop": true}})", 45).time, 0.5);
    EXPECT_DOUBLE_EQ(frame(R"({"frameRate": 10, "animation": {"loop": true, "speed": -1}})", 5).time, 1.5);
    EXPECT_EQ(frame(R"({"frameRate": 10, "animation": {"clip": "Climb"}})", 10).pose.worldFromNode[1][3].y, 1);
    EXPECT_THROW(frame(R"({"animation": {"clip": "Walk"}})", 0), Error);
    EXPECT_THROW(frame(R"({"animation": {"clip": 1}})", 0), Error);
}

TEST_F(FrameSequence, cameraKeysLookFromPositionToTarget) {
    const char* shot = R"({"frameRate": 10, "camera": {"interpolation": "linear", "keys": [
        {"frame": 0, "position": [0, 0, 2], "target": "Rising"},
        {"frame": 10, "position": [4, 0, -2], "target": "Rising"}]}})";
    const FrameMoment middle = frame(shot, 5);
    expectNear(placeOf(middle), {2, 0, 0});
    expectNear(forwardOf(middle), glm::normalize(glm::dvec3(0, 0.5, -2) - glm::dvec3(2, 0, 0)));
    EXPECT_NEAR(middle.view.worldFromCamera[0].y, 0, 1e-12) << "upright";
    const FrameMoment down =
        frame(R"({"camera": {"keys": [{"frame": 0, "position": [0, 3, 0], "target": [0, 0, 0]}]}})", 0);
    expectNear(forwardOf(down), {0, -1, 0});
    expectNear(glm::dvec3(down.view.worldFromCamera[1]), {0, 0, -1});
    EXPECT_THROW(frame(R"({"camera": {"keys": [{"frame": 0, "position": [0, 0, 0], "target": [0, 0, 0]}]}})", 0),
                 Error);
}

// A positive roll is counter-clockwise, seen from behind the camera: at 90°, the camera's right axis points up.
TEST_F(FrameSequence, cameraKeysRoll) {
    const char* shot = R"({"camera": {"interpolation": "linear", "keys": [
        {"frame": 0, "position": [0, 0, 2], "target": [0, 0, 0]},
        {"frame": 10, "position": [0, 0, 2], "target": [0, 0, 0], "roll": 180}]}})";
    expectNear(glm::dvec3(frame(shot, 0).view.worldFromCamera[0]), {1, 0, 0});
    expectNear(glm::dvec3(frame(shot, 5).view.worldFromCamera[0]), {0, 1, 0});
    expectNear(glm::dvec3(frame(shot, 5).view.worldFromCamera[1]), {-1, 0, 0});
    expectNear(forwardOf(frame(shot, 5)), {0, 0, -1});
    expectNear(glm::dvec3(frame(shot, 10).view.worldFromCamera[1]), {0, -1, 0});
}

TEST_F(FrameSequence, turntableComesBackToItsOwnPlace) {
    const char* shot = R"({"range": [10, 50], "camera": {"turntable": {"centre": "Still"}}})";
    expectNear(placeOf(frame(shot, 10)), {0, 0, 0});
    expectNear(placeOf(frame(shot, 50)), {0, 0, 0});
    // the camera has made a quarter turn, counter-clockwise seen from above
    expectNear(placeOf(frame(shot, 20)), {4, 0, -4});
    expectNear(forwardOf(frame(shot, 20)), {-1, 0, 0});
    expectNear(placeOf(frame(shot, 30)), {0, 0, -8});
}

// The exposure is centred on the frame's time. With ShutterPosition::start, it begins at that time. The camera moves
// 0.3 m per frame, and the node rises 0.1 m per frame.
TEST_F(FrameSequence, theShutterOpensAroundItsFrame) {
    base_.shutter.seconds = 0.05;
    const char* shot = R"({"frameRate": 10, "range": [0, 90], "camera": {"dolly": {"distance": 3, "frames": [10, 20],
                        "interpolation": "linear"}}})";
    const FrameMoment moving = frame(shot, 15);
    expectNear(placeOf(moving), {0, 0, -1.5});
    ASSERT_EQ(moving.view.shutterCameras.size(), 2u);
    expectNear(glm::dvec3(moving.view.shutterCameras[0][3]), {0, 0, -1.425});
    expectNear(glm::dvec3(moving.view.shutterCameras[1][3]), {0, 0, -1.575});
    ASSERT_EQ(moving.shutter.poses.size(), 2u);
    EXPECT_NEAR(moving.shutter.poses[0].worldFromNode[1][3].y, 1.475, 1e-6);
    EXPECT_NEAR(moving.pose.worldFromNode[1][3].y, 1.5, 1e-6);
    EXPECT_NEAR(moving.shutter.poses[1].worldFromNode[1][3].y, 1.525, 1e-6);
    EXPECT_TRUE(frame(shot, 40).view.shutterCameras.empty());  // the dolly has ended, so the camera stands still

    base_.shutter.position = ShutterPosition::start;
    EXPECT_NEAR(frame(shot, 15).pose.worldFromNode[1][3].y, 1.525, 1e-6);
    EXPECT_NEAR(frame(shot, 15).shutter.poses[0].worldFromNode[1][3].y, 1.5, 1e-6);
}

TEST_F(FrameSequence, dollyGoesForwardOverItsFrames) {
    const char* shot = R"({"range": [0, 90], "camera": {"dolly": {"distance": 3, "frames": [10, 20]}}})";
    expectNear(placeOf(frame(shot, 5)), {0, 0, 0});
    expectNear(placeOf(frame(shot, 15)), {0, 0, -1.5});
    expectNear(placeOf(frame(shot, 80)), {0, 0, -3});
}

TEST_F(FrameSequence, focusFollowsNodesAndPullsInDioptres) {
    EXPECT_NEAR(frame(R"({"focus": {"node": "Still"}})", 0).view.lens.focusDistance, 4, 1e-12);
    EXPECT_NEAR(frame(R"({"focus": {"node": "Still"}, "range": [0, 2], "camera": {"dolly": {"distance": 1}}})", 2)
                    .view.lens.focusDistance,
                3, 1e-12);
    const char* pull = R"({"focus": {"interpolation": "linear", "keys": [{"frame": 0, "node": "Rising"},
                                                                       {"frame": 10, "node": "Still"}]}})";
    EXPECT_NEAR(frame(pull, 5).view.lens.focusDistance, 1 / (0.5 / 2 + 0.5 / 4), 1e-12);
    EXPECT_THROW(frame(R"({"focus": {"node": "Nobody"}})", 0), Error);
    EXPECT_THROW(frame(R"({"focus": {"node": "Still"}, "range": [0, 2], "camera": {"dolly": {"distance": 9}}})", 2),
                 Error);
}

// The node that a focus key names may lie behind the camera in frames that the key does not affect.
TEST_F(FrameSequence, focusAsksOnlyForNodesNearTheirTurn) {
    const char* shot =
        R"({"range": [0, 100], "camera": {"dolly": {"distance": 3, "frames": [50, 51]}}, "focus": {"keys": [
        {"frame": 0, "node": "Rising"}, {"frame": 10, "node": "Still"}, {"frame": 20, "node": "Still"},
        {"frame": 60, "node": "Still"}]}})";
    EXPECT_NEAR(frame(shot, 60).view.lens.focusDistance, 1, 1e-9);
}

// Focus on a pixel and automatic focus find the surface that is visible in each frame. A wall recedes from 4 m to 8 m
// in 2 s; a post at 2 m hides its left part.
TEST_F(FrameSequence, focusFindsWhatThePictureShowsInEachFrame) {
    Mesh square;
    square.vertices.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.primitives = {{-1, {0, 1, 2, 0, 2, 3}}};
    scene_.meshes = {square};
    Node wall;
    wall.name = "Wall";
    wall.mesh = 0;
    wall.scale = {9, 9, 1};
    Node post;
    post.name = "Post";
    post.mesh = 0;
    post.translation = {-1.2, 0, -2};
    scene_.nodes.insert(scene_.nodes.end(), {wall, post});
    scene_.roots.insert(scene_.roots.end(), {3, 4});
    AnimationChannel away;
    away.target = 3;
    away.times = {0, 2};
    away.values = {0, 0, -4, 0, 0, -8};
    scene_.clips[0].channels.push_back(away);

    const auto focus = [&](const std::string& how, int number) {
        return frame((R"({"frameRate": 10, "focus": )" + how + "}").c_str(), number).view.lens.focusDistance;
    };
    for (const int number : {0, 5, 20}) {
        const double depth = 4 + 0.2 * number;
        EXPECT_NEAR(focus(R"({"pixel": [700, 384]})", number), depth, 1e-6);
        EXPECT_NEAR(focus(R"({"auto": true})", number), depth, 1e-6);
        EXPECT_NEAR(focus(R"({"pixel": [100, 384]})", number), 2, 1e-6);
    }
    const char* pull = R"({"interpolation": "linear", "keys": [{"frame": 0, "pixel": [100, 384]},
                                                              {"frame": 10, "auto": true}]})";
    EXPECT_NEAR(focus(pull, 5), 1 / (0.5 / 2 + 0.5 / 5), 1e-6);
    try {
        focus(R"({"pixel": [1024, 384]})", 3);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "x.json: frame 3: focus: pixel 1024,384 is outside the image of 1024x768 px");
    }
    const char* turned =
        R"({"camera": {"keys": [{"frame": 0, "position": [0, 0, 0], "target": [0, 0, 1]}]}, "focus": )";
    EXPECT_THROW(frame((turned + std::string(R"({"auto": true}})")).c_str(), 0), Error);
    EXPECT_THROW(frame((turned + std::string(R"({"pixel": [5, 5]}})")).c_str(), 0), Error);
}

TEST_F(FrameSequence, lensValuesGoTheirOwnWay) {
    const char* shot = R"({"lens": {
        "fStop": {"keys": [{"frame": 0, "value": 1}, {"frame": 10, "value": 4}], "interpolation": "linear"},
        "blurScale": {"keys": [{"frame": 0, "value": 1}, {"frame": 10, "value": 4}], "interpolation": "linear"},
        "bladeCount": {"keys": [{"frame": 0, "value": 5}, {"frame": 10, "value": 9}]},
        "bladeRotation": 90}})";
    const Lens lens = frame(shot, 5).view.lens;
    EXPECT_NEAR(lens.fStop, 2, 1e-12);
    EXPECT_NEAR(lens.blurScale, 2.5, 1e-12);
    EXPECT_EQ(lens.bladeCount, 5);
    EXPECT_NEAR(lens.bladeRotation, std::numbers::pi / 2, 1e-12);
    EXPECT_EQ(frame(shot, 10).view.lens.bladeCount, 9);
    EXPECT_EQ(frame(shot, 99).view.lens.fStop, 4);
}

// Keys animate the settings of a method as KHR_animation_pointer does; settings without keys stay constant.
TEST_F(FrameSequence, settingsOfAMethodHaveKeys) {
    const char* shot = R"({"method": "scheuermann", "methodKeys": {
        "near-blur-depth": {"keys": [{"frame": 0, "value": 1}, {"frame": 10, "value": 2}], "interpolation": "linear"},
        "blurriness-cutoff": {"keys": [{"frame": 3, "value": 0.5}]}}})";
    EXPECT_DOUBLE_EQ(frame(shot, 4).view.methodValues.at("near-blur-depth"), 1.4);
    EXPECT_DOUBLE_EQ(frame(shot, 40).view.methodValues.at("near-blur-depth"), 2);
    EXPECT_EQ(frame(shot, 0).view.methodValues.at("blurriness-cutoff"), 0.5);
    EXPECT_TRUE(frame("{}", 0).view.methodValues.empty());

    // Keys may animate only settings of the request's method, which may differ from the shot's method.
    Shot other = parseShot(shot, "x.json");
    Request request;
    applyShot(other, request);
    EXPECT_NO_THROW(settleShot(other, request, {}));
    request.method = "circular";
    try {
        settleShot(other, request, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("/methodKeys/blurriness-cutoff: method circular"), std::string::npos)
            << error.what();
    }
}

TEST_F(FrameSequence, lensFollowsTheCamerasOwnValues) {
    // gives tan(θx/2) = 0.5 at an aspect ratio of 4:3, with the horizontal field of view θx
    scene_.cameras[0].yfov = 2 * std::atan(0.375);
    scene_.cameras[0].lens = {{"fStop", 8}, {"focusDistance", 7}};
    EXPECT_EQ(frame("{}", 0).view.lens.fStop, 8);
    EXPECT_EQ(frame("{}", 0).view.lens.focusDistance, 7);
    EXPECT_EQ(frame("{}", 0).view.lens.focalLength, 50);
    EXPECT_EQ(frame(R"({"lens": {"fStop": 2}})", 0).view.lens.fStop, 2);
    base_.fixedLens = {"fStop"};
    EXPECT_EQ(frame("{}", 0).view.lens.fStop, 2.8);
    EXPECT_NEAR(frame("{}", 0).view.lens.focalLength, 36, 1e-9);
}

TEST_F(FrameSequence, faultsNameShotAndFrame) {
    try {
        static_cast<void>(frame(R"({"focus": {"node": "Nobody"}})", 7));
        FAIL();
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("x.json: /focus/node: there is no node 'Nobody'"))
            << error.what();
    }
}

TEST_F(FrameSequence, seedsDifferOnlyWhenAnimated) {
    EXPECT_EQ(frame("{}", 3).settings.seed, frame("{}", 4).settings.seed);
    std::set<std::uint32_t> seeds;
    for (int i = 0; i < 100; ++i) seeds.insert(frame(R"({"animateSeed": true})", i).settings.seed);
    EXPECT_EQ(seeds.size(), 100u);
}

TEST(ShardFrames, shareTheRangeWithoutRestAndWithoutOverlap) {
    std::multiset<int> all;
    for (int shard = 0; shard < 5; ++shard)
        for (const int frame : shardFrames({7, 40}, shard, 5)) all.insert(frame);
    ASSERT_EQ(all.size(), 34u);
    EXPECT_EQ(*all.begin(), 7);
    EXPECT_EQ(*all.rbegin(), 40);
    EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), 34u);
}

// The exposure time is interpolated geometrically. Each frame's exposure follows from its exposure time, f-number and
// ISO. If the request sets an exposure in EV, this exposure applies to all frames instead.
TEST_F(FrameSequence, exposureFollowsTheLens) {
    const char* text = R"({"output": "x/####.png", "lens": {"fStop": 2, "iso": 400, "exposureTime":
        {"interpolation": "linear", "keys": [{"frame": 0, "value": 0.01}, {"frame": 2, "value": 0.04}]}}})";
    const Shot shot = parseShot(text, "x.json");
    EXPECT_NEAR(frame(text, 1).view.lens.exposureTime, 0.02, 1e-12);
    FilmOptions options;
    options.outputs = shot.outputs;
    const std::vector<FilmFrame> film = filmFrames(shot, base_, {0, 1, 2}, options);
    EXPECT_NEAR(film[1].write.exposure, film[0].write.exposure + 1, 1e-12);
    EXPECT_NEAR(film[2].write.exposure, -std::log2(4 / 0.04 * 100 / 400) - std::log2(1.2), 1e-12);
    EXPECT_NE(film[0].settings, film[1].settings);
    options.settings.request.exposure = ExposureValue{-1.5};
    EXPECT_EQ(filmFrames(shot, base_, {0, 1}, options)[1].write.exposure, -1.5);

    const char* switched =
        R"({"lens": {"exposureTime": {"keys": [{"frame": 0, "value": 0}, {"frame": 4, "value": 1}]}}})";
    EXPECT_EQ(frame(switched, 3).view.lens.exposureTime, 0) << "no interpolation from an unset exposure time";
    EXPECT_EQ(frame(switched, 4).view.lens.exposureTime, 1);
    EXPECT_THROW((void)parseShot(R"({"exposure": 1, "lens": {"exposureTime": 0.01}})", "x.json"), Error);
}

}  // namespace
}  // namespace defocus::engine
