#include "view/state/focus_pull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace defocus::engine {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(FocusPull, goesFromOneDistanceToTheOther) {
    const FocusPull pull{1, 4, 10, 0.5};
    EXPECT_DOUBLE_EQ(pull.distanceAt(10), 1);
    EXPECT_EQ(pull.distanceAt(10.5), 4);
    EXPECT_EQ(pull.distanceAt(99), 4);
    EXPECT_FALSE(pull.over(10.49));
    EXPECT_TRUE(pull.over(10.5));
}

TEST(FocusPull, isHalfWayInDioptresAtHalfTime) {
    const FocusPull pull{1, 4, 0, 1};
    EXPECT_NEAR(1 / pull.distanceAt(0.5), 0.5 * (1 + 0.25), 1e-12);
}

TEST(FocusPull, neverTurnsBack) {
    const FocusPull pull{5, 0.5, 0, 1};
    for (double t = 0; t < 1; t += 0.01) EXPECT_GE(pull.distanceAt(t), pull.distanceAt(t + 0.01));
}

TEST(FocusPull, reachesInfinityAndComesBack) {
    EXPECT_EQ((FocusPull{2, infinity, 0, 1}).distanceAt(1), infinity);
    EXPECT_NEAR((FocusPull{2, infinity, 0, 1}).distanceAt(0.5), 4, 1e-12);
    EXPECT_EQ((FocusPull{infinity, 2, 0, 1}).distanceAt(0), infinity);
}

TEST(Eased, startsAndEndsAtRest) {
    constexpr double h = 1e-5;
    EXPECT_EQ(eased(0), 0);
    EXPECT_EQ(eased(1), 1);
    EXPECT_EQ(eased(-3), 0);
    EXPECT_EQ(eased(7), 1);
    EXPECT_NEAR(eased(h) / h, 0, 1e-4);
    EXPECT_NEAR((1 - eased(1 - h)) / h, 0, 1e-4);
}

TEST(RackedFocus, oppositeNotchesUndoEachOther) {
    EXPECT_GT(rackedFocus(2, 1), 2);
    EXPECT_NEAR(rackedFocus(rackedFocus(2, 5), -5), 2, 1e-12);
    EXPECT_EQ(rackedFocus(infinity, 1), infinity);
    EXPECT_TRUE(std::isfinite(rackedFocus(infinity, -1)));
    EXPECT_GT(rackedFocus(1e-3, -100), 0);
}

}  // namespace
}  // namespace defocus::engine
