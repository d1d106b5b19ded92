#include "lod/level_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace defocus {
namespace {

const glm::vec3 up(0, 0, 1);
const glm::vec3 right(1, 0, 0);

TEST(SmoothingGroups, JoinNormalsWithinADegreeAtOnePositionOnly) {
    const glm::vec3 almostUp = glm::normalize(glm::vec3(0.01f, 0, 1));  // 0.57°
    const std::vector<std::uint32_t> groups = smoothingGroups({up, right, almostUp, up}, {0, 0, 0, 1});
    EXPECT_EQ(groups[0], groups[2]);
    EXPECT_NE(groups[0], groups[1]);
    EXPECT_NE(groups[0], groups[3]);
}

// A roof over the ridge 1-2: a flat face of area 1/2 (normal +z) and an upright one of area 1 (normal +x).
//   ridge (0,0,0)-(0,1,0); flat to (−1,0,0), upright down to (0,0,−2)
const std::vector<glm::vec3> roof = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, -2}};

TEST(LevelNormals, AreMeansWeightedByArea) {
    const std::vector<glm::vec3> original(4, glm::normalize(up + right));
    const std::vector<glm::vec3> normals =
        levelNormals(roof, original, {0, 1, 2, 3}, std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1}, 4);
    const glm::vec3 mean = glm::normalize(0.5f * up + 1.0f * right);
    EXPECT_NEAR(glm::distance(normals[1], mean), 0, 1e-6);
    EXPECT_NEAR(glm::distance(normals[2], mean), 0, 1e-6);
    EXPECT_NEAR(glm::distance(normals[0], up), 0, 1e-6);
    EXPECT_NEAR(glm::distance(normals[3], right), 0, 1e-6);
}

TEST(LevelNormals, KeepACreaseBetweenGroups) {
    std::vector<glm::vec3> points = roof;
    points.insert(points.end(), {roof[1], roof[2]});  // the ridge once more, for the upright face
    const std::vector<glm::vec3> original = {up, up, up, right, right, right};
    const std::vector<std::uint32_t> groups = smoothingGroups(original, {0, 1, 2, 3, 1, 2});
    const std::vector<glm::vec3> normals =
        levelNormals(points, original, groups, std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4}, 6);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_NEAR(glm::distance(normals[v], original[v]), 0, 1e-6) << v;
}

TEST(LevelNormals, FollowTheShadingWhereWindingRunsAgainstIt) {
    const std::vector<glm::vec3> original(4, up);
    const std::vector<glm::vec3> normals =
        levelNormals(roof, original, {0, 1, 2, 3}, std::vector<std::uint32_t>{0, 2, 1}, 3);
    for (const glm::vec3& normal : normals) EXPECT_NEAR(glm::distance(normal, up), 0, 1e-6);
}

TEST(LevelNormals, VertexWithoutProperFaceKeepsItsOwn) {
    const std::vector<glm::vec3> original(4, right);
    const std::vector<glm::vec3> normals =
        levelNormals(roof, original, {0, 1, 2, 3}, std::vector<std::uint32_t>{1, 1, 2}, 4);
    for (const glm::vec3& normal : normals) EXPECT_EQ(normal, right);
}

}  // namespace
}  // namespace defocus
