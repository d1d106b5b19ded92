// Tests that bounds of posed objects contain every vertex of every level at many times of the animation.

#include "plan/motion/object_pose.h"

#include <gtest/gtest.h>

#include "models.h"
#include "posed_world.h"

namespace defocus::engine {
namespace {

// Returns how far a point lies outside a box along the worst axis, or 0 inside.
double outside(const Bounds& box, const glm::dvec3& point) {
    const glm::dvec3 below = box.minimum - point;
    const glm::dvec3 above = point - box.maximum;
    return std::max({below.x, below.y, below.z, above.x, above.y, above.z, 0.0});
}

void expectBoundsHold(const SmallWorld& small) {
    for (const Object& object : small.world.pose.objects) {
        const auto mesh = static_cast<std::size_t>(object.mesh);
        const Pyramid& pyramid = small.world.pyramids[mesh];
        const Bounds box = posedBox(pyramid, objectPose(object, glm::dmat4(1)), object.skinned());
        // tolerance for vertices that the CPU poses in single precision
        const double tolerance = 1e-5 * glm::length(box.size());
        for (std::uint32_t level = 0; level < pyramid.levels.size(); ++level) {
            const Mesh baked = bakedLevel(small.scene.meshes[mesh], pyramid, level, object, glm::dvec3(0));
            for (const Primitive& primitive : baked.primitives)
                for (const std::uint32_t index : primitive.indices)
                    ASSERT_LE(outside(box, glm::dvec3(baked.vertices.positions[index])), tolerance)
                        << object.name << ", level " << level;
        }
    }
}

class ObjectPoseOf : public testing::TestWithParam<PosedModel> {};

TEST_P(ObjectPoseOf, boundsHoldAllVerticesAtManyTimes) {
    const auto& [file, clip] = GetParam();
    DEFOCUS_MODEL_OR_SKIP(path, file);
    const auto small = posedWorld(path, 0, clip);
    const int last = static_cast<int>(small->scene.clips.size()) - 1;
    const double duration = last < 0 ? 0 : static_cast<double>(small->scene.clips[0].duration);
    const int times = small->world.pose.objects.size() > 10 ? 5 : 25;
    for (int i = 0; i < times; ++i) {
        poseWorld(*small, duration * i / times, std::min(clip, last));
        expectBoundsHold(*small);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, ObjectPoseOf, testing::ValuesIn(posedModels), posedModelName);

// An object's bounds contain its vertices for morph weights below 0 and above 1, too.
TEST(ObjectPose, boundsHoldForAnyMorphWeights) {
    SmallWorld small;
    small.scene.meshes.push_back(bumpySphere(24, 18, -1));
    Mesh& mesh = small.scene.meshes[0];
    mesh.morphTargets.resize(2);
    for (const glm::vec3& p : mesh.vertices.positions) {
        mesh.morphTargets[0].positions.push_back({p.y, 0.5f * p.x, 1});
        mesh.morphTargets[1].positions.push_back({-0.3f, p.z * p.z, p.x});
    }
    place(small, 0, glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3)));
    finish(small);
    for (const double a : {-1.5, 0.0, 0.4, 2.0})
        for (const double b : {-2.0, 0.0, 1.0}) {
            small.world.pose.objects[0].morphWeights = {a, b};
            expectBoundsHold(small);
        }
}

// An object's bounds contain vertices without weights, and vertices whose joints the skin lacks. Both follow the first
// joint.
TEST(ObjectPose, boundsHoldForOddWeights) {
    SmallWorld small;
    small.scene.meshes.push_back(bumpySphere(24, 18, -1));
    Vertices& vertices = small.scene.meshes[0].vertices;
    for (std::size_t v = 0; v < vertices.count(); ++v) {
        vertices.joints.push_back(v % 2 == 0 ? glm::u16vec4(1, 0, 0, 0) : glm::u16vec4(9, 0, 0, 0));
        vertices.weights.push_back({v % 3 == 0 ? 0.0f : 0.7f, 0, 0, 0});
    }
    place(small, 0, glm::dmat4(1));
    finish(small);
    small.world.pose.objects[0].worldFromJoint = {glm::translate(glm::dmat4(1), glm::dvec3(5, 0, 0)),
                                                  glm::translate(glm::dmat4(1), glm::dvec3(0, -7, 0))};
    expectBoundsHold(small);
}

TEST(ObjectPose, windingFollowsTheMajorityOfJoints) {
    Object object;
    object.worldFromJoint = {glm::dmat4(1), glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)),
                             glm::scale(glm::dmat4(1), glm::dvec3(1, -2, 1)), glm::dmat4(0)};
    EXPECT_TRUE(mirrors(objectPose(object, glm::dmat4(1))));
    object.worldFromJoint.pop_back();
    object.worldFromJoint.back() = glm::dmat4(1);
    EXPECT_FALSE(mirrors(objectPose(object, glm::dmat4(1))));
    EXPECT_DOUBLE_EQ(largestScale(objectPose(object, glm::scale(glm::dmat4(1), glm::dvec3(3)))), 3);
}

}  // namespace
}  // namespace defocus::engine
