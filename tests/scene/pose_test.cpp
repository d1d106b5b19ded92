// Compares poses of node hierarchies and key frames with values computed by hand.

#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/error.h"
#include "near.h"
#include "scene/animation.h"

namespace defocus::engine {
namespace {

Mesh triangleMesh() {
    Mesh mesh;
    mesh.vertices.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {100, 100, 100}};
    mesh.primitives = {{-1, {0, 1, 2}}};
    return mesh;
}

// Returns a scene with a parent node at (10, 0, 0), rotated by a quarter turn about z and scaled by 2, whose child at
// (1, 0, 0) draws a triangle.
Scene parentAndChild() {
    Scene scene;
    scene.meshes = {triangleMesh()};
    scene.nodes.resize(2);
    scene.nodes[0].name = "parent";
    scene.nodes[0].children = {1};
    scene.nodes[0].translation = {10, 0, 0};
    scene.nodes[0].rotation = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 0, 1));
    scene.nodes[0].scale = glm::dvec3(2);
    scene.nodes[1].name = "child";
    scene.nodes[1].parent = 0;
    scene.nodes[1].mesh = 0;
    scene.nodes[1].translation = {1, 0, 0};
    scene.roots = {0};
    return scene;
}

TEST(Pose, childrenFollowTheirParents) {
    const Scene scene = parentAndChild();
    const Pose pose = poseAt(scene, 0);
    // (1, 0, 0) is scaled to (2, 0, 0), rotated to (0, 2, 0) and moved to (10, 2, 0).
    expectNear(glm::dvec3(pose.worldFromNode[1][3]), {10, 2, 0});
    ASSERT_EQ(pose.objects.size(), 1u);
    EXPECT_EQ(pose.objects[0].name, "child");
    // The triangle's corners are at (10, 2), (10, 4) and (8, 2); the bounds ignore the unused vertex.
    expectNear(pose.bounds.minimum, {8, 2, 0});
    expectNear(pose.bounds.maximum, {10, 4, 0});
    expectNear(nodeCentre(scene, pose, 1), {9, 3, 0});
    expectNear(nodeCentre(scene, pose, 0), {10, 0, 0});
}

// Poses are in metres. For a scene in centimetres, all lengths are multiplied by 0.01, including the lengths of cameras
// and lights. The illuminance on surfaces stays the same.
TEST(Pose, isInMetres) {
    Scene scene = parentAndChild();
    scene.metresPerUnit = 0.01;
    scene.cameras.resize(1);
    scene.cameras[0].znear = 10;
    scene.cameras[0].lens = {{"focusDistance", 250}, {"fStop", 2}};
    scene.nodes[1].light = 0;
    scene.lights.resize(1);
    scene.lights[0].type = LightType::point;
    scene.lights[0].intensity = 5;
    scene.lights[0].range = 300;
    const Pose pose = poseAt(scene, 0);
    expectNear(pose.bounds.minimum, {0.08, 0.02, 0});
    expectNear(pose.bounds.maximum, {0.10, 0.04, 0});
    EXPECT_NEAR(pose.cameras[0].znear, 0.1, 1e-12);
    EXPECT_NEAR(pose.cameras[0].lens.at("focusDistance"), 2.5, 1e-12);
    EXPECT_EQ(pose.cameras[0].lens.at("fStop"), 2);
    expectNear(pose.lights[0].position, {0.10, 0.02, 0});
    EXPECT_NEAR(pose.lights[0].light.range, 3, 1e-6);
    // A light gives the same illuminance at a distance of 7 units whether the unit is 1 cm or 1 m.
    EXPECT_NEAR(pose.lights[0].light.intensity / (0.07 * 0.07), 5.0 / (7 * 7), 1e-6);
}

TEST(Pose, nodesOutsideTheSceneDrawNothing) {
    Scene scene = parentAndChild();
    scene.roots = {};
    const Pose pose = poseAt(scene, 0);
    EXPECT_TRUE(pose.objects.empty());
    EXPECT_TRUE(pose.bounds.empty());
    // nodes outside the scene also have matrices, since they may be joints of its skins
    expectNear(glm::dvec3(pose.worldFromNode[1][3]), {10, 2, 0});
}

TEST(Pose, matricesReplaceTheThreeParts) {
    Scene scene = parentAndChild();
    scene.nodes[0].matrix = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 7));
    expectNear(glm::dvec3(poseAt(scene, 0).worldFromNode[1][3]), {1, 0, 7});
}

TEST(Pose, skinsArePlacedByTheirJointsNotByTheirNode) {
    Scene scene = parentAndChild();
    scene.nodes[1].skin = 0;
    scene.nodes.push_back({});
    scene.nodes[2].translation = {0, 0, 5};
    scene.roots = {0, 2};
    scene.skins = {{"", {2}, {glm::translate(glm::mat4(1), glm::vec3(0, 0, -2))}}};
    scene.meshes[0].vertices.joints.assign(4, glm::u16vec4(0));
    scene.meshes[0].vertices.weights.assign(4, {1, 0, 0, 0});
    const Pose pose = poseAt(scene, 0);
    expectNear(glm::dvec3(pose.objects.at(0).worldFromObject[3]), {0, 0, 3});
    expectNear(pose.bounds.minimum, {0, 0, 3});
    expectNear(pose.bounds.maximum, {1, 1, 3});
}

TEST(Pose, unknownNamesListTheKnownOnes) {
    const Scene scene = parentAndChild();
    EXPECT_EQ(nodeNamed(scene, "child"), 1);
    try {
        (void)nodeNamed(scene, "uncle");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "there is no node 'uncle'; the scene has: parent, child");
    }
    try {
        (void)nodeNamed(scene, "Parents");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "there is no node 'Parents'; did you mean 'parent'?");
    }
}

AnimationChannel channelOf(Interpolation interpolation, ChannelPath path, std::vector<float> times,
                           std::vector<float> values) {
    return {0, path, interpolation, std::move(times), std::move(values), ""};
}

double valueAt(const AnimationChannel& channel, double time) {
    return sampleValues(channel, 1, time).at(0);
}

TEST(Animation, stepHoldsItsKey) {
    const AnimationChannel channel = channelOf(Interpolation::step, ChannelPath::weights, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(valueAt(channel, 0), 10);
    EXPECT_EQ(valueAt(channel, 1), 10);
    EXPECT_EQ(valueAt(channel, 1.999), 10);
    EXPECT_EQ(valueAt(channel, 2), 20);
    EXPECT_EQ(valueAt(channel, 3.9), 20);
    EXPECT_EQ(valueAt(channel, 4), 30);
    EXPECT_EQ(valueAt(channel, 100), 30);
}

TEST(Animation, linearMeetsItsKeysAndHalves) {
    const AnimationChannel channel = channelOf(Interpolation::linear, ChannelPath::weights, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(valueAt(channel, -5), 10);
    EXPECT_EQ(valueAt(channel, 1.5), 15);
    EXPECT_EQ(valueAt(channel, 2), 20);
    EXPECT_EQ(valueAt(channel, 3), 25);
    EXPECT_EQ(valueAt(channel, 9), 30);
}

TEST(Animation, cubicSplineReproducesACubic) {
    // The keys are values and slopes of x(t) = t³ − 2t² + 3 at t = 0, 1 and 3. A Hermite spline reproduces a cubic
    // exactly.
    const auto x = [](double t) { return t * t * t - 2 * t * t + 3; };
    const auto slope = [](double t) { return static_cast<float>(3 * t * t - 4 * t); };
    std::vector<float> values;
    for (const double t : {0.0, 1.0, 3.0}) values.insert(values.end(), {slope(t), static_cast<float>(x(t)), slope(t)});
    const AnimationChannel channel = channelOf(Interpolation::cubicSpline, ChannelPath::weights, {0, 1, 3}, values);
    for (double t = 0; t <= 3; t += 0.125) EXPECT_NEAR(valueAt(channel, t), x(t), 1e-5) << t;
    EXPECT_EQ(valueAt(channel, -1), 3);
    EXPECT_EQ(valueAt(channel, 8), 12);
}

TEST(Animation, rotationsTurnEvenlyAlongTheShorterArc) {
    const auto turn = [](double degrees, float sign) {
        const glm::dquat q = glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 1, 0));
        return std::array<float, 4>{sign * static_cast<float>(q.x), sign * static_cast<float>(q.y),
                                    sign * static_cast<float>(q.z), sign * static_cast<float>(q.w)};
    };
    // The second key is the negated quaternion for 80°, which is the same rotation. Interpolation without a sign change
    // would rotate by 280° instead.
    std::vector<float> values;
    for (const auto& key : {turn(0, 1), turn(80, -1)}) values.insert(values.end(), key.begin(), key.end());
    const AnimationChannel channel = channelOf(Interpolation::linear, ChannelPath::rotation, {0, 1}, values);
    for (const double t : {0.25, 0.5, 0.75}) {
        const glm::dvec3 turned = sampleRotation(channel, t) * glm::dvec3(0, 0, 1);
        const double angle = glm::radians(80 * t);
        expectNear(turned, {std::sin(angle), 0, std::cos(angle)}, 1e-6);
    }
}

TEST(Animation, cubicRotationsAreNormalised) {
    const AnimationChannel channel =
        channelOf(Interpolation::cubicSpline, ChannelPath::rotation, {0, 1},
                  {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_NEAR(glm::length(sampleRotation(channel, 0.5)), 1.0, 1e-12);
    // Half-way between the keys, both have the same weight, which gives a quarter turn about x.
    expectNear(sampleRotation(channel, 0.5) * glm::dvec3(0, 1, 0), {0, 0, 1}, 1e-6);
}

TEST(Animation, clipsMoveTheirNodes) {
    Scene scene = parentAndChild();
    AnimationClip clip;
    clip.duration = 2;
    clip.channels = {channelOf(Interpolation::linear, ChannelPath::translation, {0, 2}, {0, 0, 0, 4, 6, 8}),
                     channelOf(Interpolation::step, ChannelPath::scale, {0}, {1, 1, 3})};
    scene.clips = {clip};
    expectNear(glm::dvec3(poseAt(scene, 1).worldFromNode[0][3]), {2, 3, 4});
    EXPECT_NEAR(glm::length(glm::dvec3(poseAt(scene, 1).worldFromNode[0][2])), 3, 1e-12);
    expectNear(glm::dvec3(poseAt(scene, 1, -1).worldFromNode[0][3]), {10, 0, 0});
    EXPECT_THROW((void)poseAt(scene, 1, 1), Error);
}

TEST(Pose, keepsTheLightsOfTheLargestIntensity) {
    Scene scene;
    constexpr std::size_t count = maxLights + 3;
    for (std::size_t i = 0; i < count; ++i) {
        Light light;
        light.type = i == 1 ? LightType::directional : LightType::point;
        light.intensity = static_cast<float>(i + 1);
        scene.lights.push_back(light);
        Node node;
        node.light = static_cast<int>(i);
        scene.nodes.push_back(node);
        scene.roots.push_back(static_cast<int>(i));
    }
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.lights.size(), maxLights);
    EXPECT_EQ(pose.faintLights, 3u);
    EXPECT_EQ(pose.lights[0].light.type, LightType::directional);
    EXPECT_EQ(pose.lights[1].light.intensity, 5);
    EXPECT_EQ(pose.lights.back().light.intensity, static_cast<float>(count));
}

}  // namespace
}  // namespace defocus::engine
