#include "lod/simplify/quadric.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

const glm::dvec3 corner[3] = {{0.1, 0.2, 0.3}, {1.1, 0.2, 0.5}, {0.3, 1.4, 0.2}};
constexpr double area = 0.7;
constexpr std::size_t attributeCount = 8;  // 3 for the normal, 3 for the colour and 2 for the texture coordinates
using Row = AttributeRow<attributeCount>;
using Gradients = AttributeGradients<attributeCount>;
using FullQuadric = AttributeQuadric<attributeCount>;

// Returns the attributes at a point; each is a linear function of the position.
Row fieldAt(const glm::dvec3& p) {
    Row row;
    for (std::size_t j = 0; j < attributeCount; ++j)
        row[j] = static_cast<float>(0.1 * double(j) + 0.3 * p.x - 0.2 * double(j) * p.y + 0.25 * p.z);
    return row;
}

Gradients gradientsOf(const glm::dvec3& third) {
    const glm::dvec3 points[3] = {corner[0], corner[1], third};
    const Row rows[3] = {fieldAt(points[0]), fieldAt(points[1]), fieldAt(points[2])};
    const glm::dvec3* p[3] = {&points[0], &points[1], &points[2]};
    const Row* s[3] = {&rows[0], &rows[1], &rows[2]};
    return attributeGradients(p, s);
}

// Returns the quadric, at corner 0, of a single face whose corner 2 is `third`.
FullQuadric quadricOf(const glm::dvec3& third) {
    FullQuadric quadric;
    quadric.addFace(gradientsOf(third), area);
    return quadric;
}

Row changeBetween(const Row& from, const Row& to) {
    Row change;
    for (std::size_t j = 0; j < attributeCount; ++j) change[j] = to[j] - from[j];
    return change;
}

Row changeTo(const glm::dvec3& p) {
    return changeBetween(fieldAt(corner[0]), fieldAt(p));
}

TEST(AttributeQuadric, aLinearFieldCostsNothingInTheFacesPlane) {
    const FullQuadric quadric = quadricOf(corner[2]);
    for (const double u : {-1.0, 0.2, 3.0})
        for (const double v : {-2.0, 0.4, 1.0}) {
            const glm::dvec3 step = u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
            EXPECT_NEAR(quadric.at(glm::vec3(step), changeTo(corner[0] + step)), 0, 1e-4);
        }
}

TEST(AttributeQuadric, aStepCostsItsSquareTimesTheArea) {
    const FullQuadric quadric = quadricOf(corner[2]);
    Row change = changeTo(corner[1]);
    change[2] += 0.5f;
    change[7] -= 0.25f;
    EXPECT_NEAR(quadric.at(glm::vec3(corner[1] - corner[0]), change), area * (0.25 + 0.0625), 1e-5);
}

// The sum of two faces' quadrics gives the sum of their costs, even if the second quadric was stored at another vertex
// with different attributes.
TEST(AttributeQuadric, sumsLikeItsFaces) {
    const glm::vec3 step(0.1f, -0.8f, 0.1f);
    const Row change = changeBetween(fieldAt(corner[0]), fieldAt({1, 2, 3}));
    FullQuadric sum = quadricOf(corner[2]);
    const float first = sum.at(step, change);
    const FullQuadric second = quadricOf({-0.4, 0.9, 1.5});
    const glm::vec3 offset(0.3f, 0.2f, -0.5f);  // offset from the second quadric's vertex to the first quadric's vertex
    Row jump{};
    jump[1] = 0.4f;
    Row both = change;
    both[1] += jump[1];
    const float expected = first + second.at(offset + step, both);
    sum.add(second, offset, jump);
    EXPECT_NEAR(sum.at(step, change), expected, 1e-5 * expected);
    EXPECT_NEAR(sum.squares.c, second.at(offset, jump), 1e-5 * expected);
}

}  // namespace
}  // namespace defocus::engine
