#include "lod/simplify/damped_solve.h"

#include <gtest/gtest.h>

#include <limits>

namespace defocus::engine {
namespace {

// The solver reads only the lower half of the matrix. It adds the damping, times the mean of the diagonal, to each
// diagonal element: (4 + 0.1 · 3.5) x + 2 y = 1 and 2 x + (3 + 0.1 · 3.5) y = 2.
TEST(DampedSolve, ReadsTheLowerHalfAndAddsTheDamping) {
    constexpr double unread = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> x = dampedSolution(std::vector<double>{4, unread, 2, 3}, std::vector<double>{1, 2}, 0.1);
    ASSERT_EQ(x.size(), 2u);
    EXPECT_NEAR(4.35 * x[0] + 2 * x[1], 1, 1e-14);
    EXPECT_NEAR(2 * x[0] + 3.35 * x[1], 2, 1e-14);
}

TEST(DampedSolve, IsZeroWithoutEquations) {
    EXPECT_EQ(dampedSolution(std::vector<double>(4, 0), std::vector<double>{1, 2}, 0.1), std::vector<double>(2, 0));
}

}  // namespace
}  // namespace defocus::engine
