#include "plan/lens_cells/contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "plan/plan_checks.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Bounds of a box between two depths in m. At a depth of 10 m, pixels and world units coincide.
ContactBounds box(double left, double bottom, double right, double top, double nearest = 10, double farthest = 10) {
    const double unit = 0.1;
    return {{left, bottom},
            {right, top},
            glm::dvec3(left, bottom, nearest / unit),
            glm::dvec3(right, top, farthest / unit),
            unit};
}

TEST(Contact, theGapIsTheLargestOfTheDistances) {
    EXPECT_EQ(contactGap(box(0, 0, 10, 10), box(10, 0, 20, 10)), 0);
    EXPECT_EQ(contactGap(box(0, 0, 10, 10), box(5, 5, 20, 10)), 0);
    EXPECT_EQ(contactGap(box(0, 0, 10, 10), box(13, 0, 20, 10)), 2);
    EXPECT_EQ(contactGap(box(0, 0, 10, 10), box(13, 15, 20, 20)), 4);
    // One box behind the other: the gap of 4 m is 2 px at a depth of 20 m.
    EXPECT_EQ(contactGap(box(0, 0, 10, 10, 12, 16), box(0, 0, 10, 10, 20, 25)), 1);
    EXPECT_EQ(contactGap(box(0, 0, 10, 10, 12, 16), box(0, 0, 10, 10, 16, 25)), 0);
    // Unlimited boxes touch every box.
    EXPECT_EQ(contactGap(ContactBounds{}, box(0, 0, 10, 10)), 0);
    EXPECT_EQ(contactGap(ContactBounds{}, ContactBounds{}), 0);
}

// The reference is the shortest path between all pairs of objects (Floyd 1962).
TEST(Contact, valuesSpreadAlongTheShortestWay) {
    std::mt19937 random(7);
    const auto uniform = [&](double min, double max) {
        return std::uniform_real_distribution<double>(min, max)(random);
    };
    // Scattered boxes, and a dense heap.
    for (const auto& [count, side] : {std::pair(1u, 400.0), {2u, 400.0}, {40u, 400.0}, {150u, 400.0}, {150u, 30.0}}) {
        std::vector<ContactBounds> bounds;
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = uniform(-20, side);
            const double y = uniform(-20, 0.75 * side);
            const double depth = uniform(10, 50);
            bounds.push_back(box(x, y, x + uniform(0, 25), y + uniform(0, 25), depth, depth + uniform(0, 8)));
            values.push_back(uniform(3, 8));
        }
        if (count > 100) bounds[17] = ContactBounds{};
        std::vector<std::vector<double>> ways(count, std::vector<double>(count));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j) {
                ways[i][j] = i == j ? 0 : contactGap(bounds[i], bounds[j]);
                EXPECT_EQ(contactGap(bounds[i], bounds[j]), contactGap(bounds[j], bounds[i]));
            }
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < count; ++j) ways[i][j] = std::min(ways[i][j], ways[i][k] + ways[k][j]);
        const std::vector<double> spread = spreadOverContact(bounds, values, 3, 8);
        for (std::size_t i = 0; i < count; ++i) {
            double expected = 3;
            for (std::size_t j = 0; j < count; ++j) expected = std::max(expected, values[j] - ways[i][j]);
            EXPECT_NEAR(spread[i], expected, 1e-12) << count;
            for (std::size_t j = 0; j < count; ++j) {
                if (contactGap(bounds[i], bounds[j]) == 0) {
                    EXPECT_EQ(spread[i], spread[j]);
                }
            }
        }
    }
}

TEST(Contact, boundsHoldEveryVertex) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    for (const ObjectPlan& object : plan.objects) {
        const ContactBounds bounds = contactBounds(object, plan);
        for (const glm::vec3& position : small->scene.meshes[0].vertices.positions) {
            const glm::dvec3 at = object.viewFromObject * glm::dvec4(position, 1);
            const double pixels = plan.view.width / (2 * plan.tanHalfHorizontal);
            const glm::dvec2 seen =
                glm::dvec2(plan.view.width, plan.view.height) / 2.0 + glm::dvec2(at) / -at.z * pixels;
            for (int axis = 0; axis < 2; ++axis) {
                EXPECT_GE(seen[axis], bounds.seenMin[axis] - 1e-9);
                EXPECT_LE(seen[axis], bounds.seenMax[axis] + 1e-9);
                EXPECT_GE(at[axis], bounds.min[axis] * bounds.unit - 1e-9);
                EXPECT_LE(at[axis], bounds.max[axis] * bounds.unit + 1e-9);
            }
            EXPECT_GE(-at.z, bounds.min.z * bounds.unit - 1e-9);
            EXPECT_LE(-at.z, bounds.max.z * bounds.unit + 1e-9);
        }
    }
}

}  // namespace
}  // namespace defocus::engine
