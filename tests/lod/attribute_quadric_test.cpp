#include "lod/attribute_quadric.h"

#include <gtest/gtest.h>

namespace defocus {
namespace {

const glm::dvec3 corner[3] = {{0.1, 0.2, 0.3}, {1.1, 0.2, 0.5}, {0.3, 1.4, 0.2}};
constexpr double area = 0.7;

// A field that is linear in space.
AttributeRow fieldAt(const glm::dvec3& p) {
    AttributeRow row;
    for (std::size_t j = 0; j < attributeCount; ++j)
        row[j] = static_cast<float>(0.1 * double(j) + 0.3 * p.x - 0.2 * double(j) * p.y + 0.25 * p.z);
    return row;
}

AttributeQuadric quadricOf(const glm::dvec3& third) {
    const glm::dvec3 points[3] = {corner[0], corner[1], third};
    const AttributeRow rows[3] = {fieldAt(points[0]), fieldAt(points[1]), fieldAt(points[2])};
    const glm::dvec3* p[3] = {&points[0], &points[1], &points[2]};
    const AttributeRow* s[3] = {&rows[0], &rows[1], &rows[2]};
    AttributeQuadric quadric;
    quadric.addFace(p, s, area);
    return quadric;
}

TEST(AttributeQuadric, aLinearFieldCostsNothingInTheFacesPlane) {
    const AttributeQuadric quadric = quadricOf(corner[2]);
    for (const double u : {-1.0, 0.2, 3.0})
        for (const double v : {-2.0, 0.4, 1.0}) {
            const glm::dvec3 p = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
            EXPECT_NEAR(quadric.at(p, fieldAt(p)), 0, 1e-10);
        }
}

TEST(AttributeQuadric, aStepCostsItsSquareTimesTheArea) {
    const AttributeQuadric quadric = quadricOf(corner[2]);
    AttributeRow row = fieldAt(corner[1]);
    row[2] += 0.5f;
    row[7] -= 0.25f;
    EXPECT_NEAR(quadric.at(corner[1], row), area * (0.25 + 0.0625), 1e-6);
}

TEST(AttributeQuadric, sumsLikeItsFaces) {
    AttributeQuadric sum = quadricOf(corner[2]);
    const AttributeQuadric other = quadricOf({-0.4, 0.9, 1.5});
    const glm::dvec3 p(0.2, -0.6, 0.4);
    const AttributeRow row = fieldAt({1, 2, 3});
    const double expected = sum.at(p, row) + other.at(p, row);
    sum.add(other);
    EXPECT_NEAR(sum.at(p, row), expected, 1e-9 * expected);
}

}  // namespace
}  // namespace defocus
