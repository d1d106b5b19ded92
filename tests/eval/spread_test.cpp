#include "eval/spread.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

TEST(Spread, ofOneToElevenInAnyOrder) {
    const Spread spread = spreadOf({11, 3, 5, 1, 9, 7, 2, 4, 10, 6, 8});
    EXPECT_DOUBLE_EQ(spread.median, 6);
    EXPECT_DOUBLE_EQ(spread.low, 2);
    EXPECT_DOUBLE_EQ(spread.high, 10);
}

TEST(Spread, interpolatesBetweenTwo) {
    const Spread spread = spreadOf({10, 20});
    EXPECT_DOUBLE_EQ(spread.median, 15);
    EXPECT_DOUBLE_EQ(spread.low, 11);
    EXPECT_DOUBLE_EQ(spread.high, 19);
}

TEST(Spread, ofOneAndOfNone) {
    EXPECT_DOUBLE_EQ(spreadOf({3}).high, 3);
    EXPECT_DOUBLE_EQ(spreadOf({}).median, 0);
}

}  // namespace
}  // namespace defocus::engine
