// Casts rays at a few triangles for which the hits are known.

#include "scene/pick.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>

namespace defocus::engine {
namespace {

// Divides each triangle at the midpoints of its edges into four.
Mesh divided(const Mesh& coarse) {
    Mesh mesh;
    Primitive& fine = mesh.primitives.emplace_back();
    const auto add = [&](const glm::vec3& position) {
        fine.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.positions.size()));
        mesh.vertices.positions.push_back(position);
    };
    const std::vector<std::uint32_t>& indices = coarse.primitives.front().indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        std::array<glm::vec3, 3> p;
        std::array<glm::vec3, 3> middle;
        for (std::size_t k = 0; k < 3; ++k) p[k] = coarse.vertices.positions[indices[i + k]];
        for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5f * (p[k] + p[(k + 1) % 3]);
        for (std::size_t k = 0; k < 3; ++k)
            for (const glm::vec3& corner : {p[k], middle[k], middle[(k + 2) % 3]}) add(corner);
        for (const glm::vec3& corner : middle) add(corner);
    }
    return mesh;
}

// Returns the cube from −1 to 1, with 768 triangles.
Mesh cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    mesh.primitives = {{-1, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}}};
    return divided(divided(divided(mesh)));
}

Scene cubes(const std::vector<glm::dmat4>& places) {
    Scene scene;
    scene.meshes = {cube()};
    for (std::size_t i = 0; i < places.size(); ++i) {
        Node node;
        node.mesh = 0;
        node.matrix = places[i];
        scene.nodes.push_back(node);
        scene.roots.push_back(static_cast<int>(i));
    }
    return scene;
}

std::optional<Hit> cast(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction) {
    return firstHit(scene, poseAt(scene, 0), origin, direction);
}

TEST(Pick, nearestOfSeveralObjects) {
    const Scene scene = cubes({glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -20)),
                               glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -10)), glm::dmat4(1)});
    const auto hit = cast(scene, {0.25, 0.5, 30}, {0, 0, -7});  // the direction need not be normalised
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->object, 2);
    EXPECT_NEAR(hit->distance, 29, 1e-12);
    const auto behind = cast(scene, {0.25, 0.5, -5}, {0, 0, -1});
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->object, 1);
    EXPECT_NEAR(behind->distance, 4, 1e-12);
}

TEST(Pick, missesBesideAndBehind) {
    const Scene scene = cubes({glm::dmat4(1)});
    EXPECT_FALSE(cast(scene, {1.001, 0, 5}, {0, 0, -1}));
    EXPECT_FALSE(cast(scene, {0, 0, 5}, {0, 0, 1}));
    EXPECT_TRUE(cast(scene, {0, 0, 0}, {0, 0, 1})) << "from inside, the back of the far face";
}

TEST(Pick, distancesAreInTheWorldForScaledAndFarObjects) {
    const glm::dmat4 place =
        glm::scale(glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(1e7, 0, 0)), 0.7, glm::dvec3(0, 0, 1)),
                   glm::dvec3(3, 3, -5));
    const auto hit = cast(cubes({place}), {1e7, 0, 40}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 35, 1e-6);
}

TEST(Pick, flattenedObjectsAreSeen) {
    const auto hit = cast(cubes({glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0))}), {0.1, 0.2, 4}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 4, 1e-12);
}

// For random rays, the hits on a cube agree with the slab test on its bounding box. A matrix that is applied to both
// the cube and the rays does not change the result.
TEST(Pick, agreesWithTheBoxItself) {
    const glm::dmat4 crooked(glm::dmat3(0.5, 2, 0, -0.3, 0.1, 1, 7, 0.2, 0.4));
    for (const glm::dmat4& place : {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(40, -3, 9)) * crooked}) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-3, 3);
        const Scene scene = cubes({place});
        const Pose pose = poseAt(scene, 0);
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 origin(any(random), any(random), any(random) + 6);
            const glm::dvec3 direction(any(random), any(random), -6);
            double enter = -1e300, leave = 1e300;
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (-1 - origin[axis]) / direction[axis];
                const double b = (1 - origin[axis]) / direction[axis];
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            const glm::dvec3 inWorld(place * glm::dvec4(direction, 0));
            const auto hit = firstHit(scene, pose, glm::dvec3(place * glm::dvec4(origin, 1)), inWorld);
            ASSERT_EQ(hit.has_value(), enter <= leave) << i;
            if (hit) {
                EXPECT_NEAR(hit->distance, enter * glm::length(inWorld), 1e-8);
                ++hits;
            }
        }
        EXPECT_GT(hits, 200);
    }
}

// Many rays, tested against triangles sorted in space, have the same hits as each ray alone, tested against all
// triangles.
TEST(Pick, manyRaysHitWhatEachHitsAlone) {
    const Scene scene =
        cubes({glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0, -6)),
               glm::rotate(glm::dmat4(1), 0.6, glm::dvec3(1, 2, 3)), glm::scale(glm::dmat4(1), glm::dvec3(3, 3, 0))});
    const Pose pose = poseAt(scene, 0);
    const glm::dvec3 origin(0.3, 0.2, 5);
    std::vector<glm::dvec3> directions;
    for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) directions.emplace_back(0.04 * x, 0.04 * y, -1);
    const auto hits = firstHits(scene, pose, origin, directions);
    std::set<int> objects;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const auto alone = firstHit(scene, pose, origin, directions[i]);
        ASSERT_EQ(hits[i].has_value(), alone.has_value()) << i;
        if (!alone) continue;
        EXPECT_EQ(hits[i]->distance, alone->distance) << i;
        EXPECT_EQ(hits[i]->object, alone->object) << i;
        objects.insert(alone->object);
    }
    EXPECT_EQ(objects, (std::set<int>{1, 2}));
}

}  // namespace
}  // namespace defocus::engine
