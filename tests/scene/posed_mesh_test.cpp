// Compares vertices posed by morph targets and skins on the CPU with matrix products that the tests write out.

#include "scene/posed_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "near.h"
#include "scene/pick.h"

namespace defocus::engine {
namespace {

void expectNearInFloat(const glm::dvec3& a, const glm::dvec3& b) {
    expectNear(a, b, 1e-6);
}

constexpr double quarter = std::numbers::pi / 2;

// Returns a triangle whose vertices all follow joint 0 until a test changes the weights.
Mesh skinnedTriangle() {
    Mesh mesh;
    mesh.vertices.positions = {{1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    mesh.vertices.normals.assign(3, {1, 0, 0});
    mesh.vertices.joints.assign(3, {0, 1, 2, 3});
    mesh.vertices.weights.assign(3, {1, 0, 0, 0});
    mesh.primitives = {{-1, {0, 1, 2}}};
    return mesh;
}

Object twoJoints() {
    Object object;
    object.worldFromJoint = {glm::translate(glm::dmat4(1), glm::dvec3(10, 0, 0)),
                             glm::rotate(glm::dmat4(1), quarter, glm::dvec3(0, 0, 1))};
    object.worldFromObject = object.worldFromJoint.front();
    return object;
}

TEST(PosedMesh, jointsMoveByTheirWeights) {
    Mesh mesh = skinnedTriangle();
    mesh.vertices.weights = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0.25f, 0.75f, 0, 0}};
    const std::vector<glm::dvec3> positions = posedPositions(mesh, twoJoints());
    expectNearInFloat(positions[0], {11, 0, 0});
    expectNearInFloat(positions[1], {0, 2, 0});  // the vertex (2, 0, 0), rotated by a quarter turn
    expectNearInFloat(positions[2], 0.25 * glm::dvec3(10, 1, 0) + 0.75 * glm::dvec3(-1, 0, 0));
}

TEST(PosedMesh, eightInfluencesAddUp) {
    Mesh mesh = skinnedTriangle();
    mesh.vertices.joints.assign(3, {0, 1, 2, 3});
    mesh.vertices.joints1.assign(3, {4, 5, 6, 7});
    mesh.vertices.weights.assign(3, glm::vec4(0.125f));
    mesh.vertices.weights1.assign(3, glm::vec4(0.125f));
    Object object;
    glm::dvec3 sum(0);
    for (int j = 0; j < 8; ++j) {
        object.worldFromJoint.push_back(glm::translate(glm::dmat4(1), glm::dvec3(j, j * j, 1)));
        sum += glm::dvec3(j, j * j, 1) / 8.0;
    }
    expectNearInFloat(posedPositions(mesh, object)[0], glm::dvec3(1, 0, 0) + sum);
}

TEST(PosedMesh, weightsThatAreNoneAndJointsThatAreMissing) {
    Mesh mesh = skinnedTriangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    mesh.vertices.weights = {{nan, 0.5f, -1, 0}, {0, 0, 0, 0}, {0, 0, 0, 3}};
    const std::vector<glm::dvec3> positions = posedPositions(mesh, twoJoints());
    expectNearInFloat(positions[0], {0, 1, 0});   // only joint 1 has a weight; the weight is normalized to 1
    expectNearInFloat(positions[1], {12, 0, 0});  // without weights, the vertex follows the first joint
    expectNearInFloat(positions[2], {10, 1, 0});  // joint 3 does not exist, so the vertex follows the first joint
}

TEST(PosedMesh, morphTargetsComeBeforeTheSkin) {
    Mesh mesh = skinnedTriangle();
    mesh.vertices.weights.assign(3, {0, 1, 0, 0});
    mesh.morphTargets = {{{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {}, {}}, {{{0, 0, 2}, {0, 0, 2}, {0, 0, 2}}, {}, {}}, {}};
    Object object = twoJoints();
    object.morphWeights = {0.5, -1, 7};
    expectNearInFloat(posedPositions(mesh, object)[0], {0, 1.5, -2});
    // the first weight is NaN, and there are fewer weights than targets
    object.morphWeights = {std::numeric_limits<double>::quiet_NaN(), 0};
    expectNearInFloat(posedPositions(mesh, object)[0], {0, 1, 0});
}

// A normal stays perpendicular to its plane under non-uniform scaling, and keeps its length.
TEST(PosedMesh, normalsStayPerpendicularUnderStretch) {
    Mesh mesh = skinnedTriangle();
    mesh.vertices.positions = {{0, 0, 0}, {1, -1, 0}, {0, 0, 1}};
    const glm::vec3 normal = 0.8f * glm::normalize(glm::vec3(1, 1, 0));
    mesh.vertices.normals.assign(3, normal);
    Object object;
    object.worldFromJoint = {glm::scale(glm::dmat4(1), glm::dvec3(3, 1, -2))};
    const std::vector<glm::dvec3> p = posedPositions(mesh, object);
    for (const glm::vec3& n : posedNormals(mesh, object)) {
        EXPECT_NEAR(glm::dot(glm::dvec3(n), p[1] - p[0]), 0, 1e-6);
        EXPECT_NEAR(glm::dot(glm::dvec3(n), p[2] - p[0]), 0, 1e-6);
        EXPECT_NEAR(glm::length(n), 0.8, 1e-6);
        EXPECT_GT(n.x, 0);
    }
}

TEST(PosedMesh, plainObjectsAreOnlyPlaced) {
    Mesh mesh = skinnedTriangle();
    Object object;
    object.worldFromObject = glm::translate(glm::dmat4(1), glm::dvec3(0, 5, 0));
    object.morphWeights = {0, 0};
    EXPECT_FALSE(deformed(object));
    expectNearInFloat(posedPositions(mesh, object)[1], {2, 5, 0});
    expectNearInFloat(posedBounds(mesh, object).maximum, {2, 6, 0});
}

// Rays hit the posed triangle: its joint moves it in front of the ray.
TEST(PosedMesh, raysMeetThePosedTriangle) {
    Scene scene;
    scene.meshes = {skinnedTriangle()};
    scene.meshes[0].vertices.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    scene.nodes.resize(2);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].skin = 0;
    scene.nodes[1].translation = {50, 0, -4};
    scene.roots = {0, 1};
    scene.skins = {{"", {1}, {glm::mat4(1)}}};
    const Pose pose = poseAt(scene, 0);
    EXPECT_FALSE(firstHit(scene, pose, {0, 0, 10}, {0, 0, -1}));
    const auto hit = firstHit(scene, pose, {50, 0, 10}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 14, 1e-9);
    expectNearInFloat(nodeCentre(scene, pose, 0), {50, 0, -4});
}

}  // namespace
}  // namespace defocus::engine
