// Tests that the length of a coarse level's normals equals the mean cosine of the angle between the level's normals and
// those of the fine surface.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/matrix.hpp>

#include "lod/pyramid/pyramid.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// Means over every fifth vertex of a ball. The ray from the centre through the vertex hits the level's surface, where
// the level's normal is interpolated. `cosine` is the cosine of the angle between the vertex normal and this normal;
// `length` is the length of this normal.
struct Agreement {
    double cosine = 0;
    double length = 0;
};

Agreement agreementOf(const Mesh& ball, const Pyramid& pyramid, std::size_t number) {
    const PyramidLevel& level = pyramid.levels[number];
    const IndexRange& range = level.primitives[0];
    Agreement sum;
    double count = 0;
    for (std::size_t v = 0; v < ball.vertices.count(); v += 5) {
        for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
            const std::uint32_t* const corner = &pyramid.indices[i];
            const glm::dmat3 corners(level.positions[corner[0]], level.positions[corner[1]],
                                     level.positions[corner[2]]);
            const glm::dvec3 along = glm::inverse(corners) * glm::dvec3(ball.vertices.positions[v]);
            if (!(std::min({along.x, along.y, along.z}) >= 0)) continue;
            const glm::dvec3 weights = along / (along.x + along.y + along.z);
            glm::dvec3 normal(0);
            double length = 0;
            for (int k = 0; k < 3; ++k) {
                normal += weights[k] * glm::dvec3(level.normals[corner[k]]);
                length += weights[k] * glm::length(glm::dvec3(level.normals[corner[k]]));
            }
            sum.cosine += glm::dot(glm::normalize(normal), glm::dvec3(ball.vertices.normals[v]));
            sum.length += length;
            ++count;
            break;
        }
    }
    EXPECT_GT(count, 0.19 * static_cast<double>(ball.vertices.count())) << "level " << number;
    return {sum.cosine / count, sum.length / count};
}

// Levels of a smooth ball keep normals of length 1, even on large triangles, so that a mirror stays a mirror.
TEST(LevelNormals, ofASmoothBallStayWhole) {
    Mesh ball = sphere(96, 48);
    for (std::size_t v = 0; v < ball.vertices.count(); ++v)
        ball.vertices.normals[v] = glm::normalize(ball.vertices.positions[v]);
    const Pyramid pyramid = buildPyramid(ball);
    ASSERT_GT(pyramid.levels.size(), 5u);
    for (std::size_t l = 1; l <= 5; ++l) {
        for (const glm::vec3& normal : pyramid.levels[l].normals) ASSERT_GT(glm::length(normal), 0.99) << "level " << l;
        EXPECT_GT(agreementOf(ball, pyramid, l).length, 0.9995) << "level " << l;
    }
}

// Levels that lose the bumps of a ball have normals shorter than 1. The length of a normal equals the mean cosine of
// the angle between it and the ball's normals.
TEST(LevelNormals, ofABumpyBallAreAsLongAsTheyAgree) {
    const Mesh ball = sphere(96, 48, 0.04);
    const Pyramid pyramid = buildPyramid(ball);
    ASSERT_GT(pyramid.levels.size(), 5u);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const Agreement agreement = agreementOf(ball, pyramid, l);
        EXPECT_NEAR(agreement.length, agreement.cosine, 0.005) << "level " << l;
    }
    EXPECT_LT(agreementOf(ball, pyramid, pyramid.levels.size() - 1).length, 0.995);
}

}  // namespace
}  // namespace defocus::engine
