#include "view/state/photographic_stops.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

TEST(PhotographicStops, areThirdsOfAStop) {
    const auto stops = thirdStops();
    for (std::size_t i = 1; i < stops.size(); ++i) {
        const double thirds = 6 * std::log2(stops[i] / stops[i - 1]);  // one stop is a factor of √2 in the f-number
        EXPECT_NEAR(thirds, 1, 0.6) << stops[i];                       // manufacturers round the f-numbers
    }
    EXPECT_NEAR(6 * std::log2(stops.back() / stops.front()), static_cast<double>(stops.size() - 1), 0.5);
}

TEST(PhotographicStops, threeStepsAreAWholeStop) {
    EXPECT_EQ(steppedStop(1.4, 3), 2);
    EXPECT_EQ(steppedStop(2, 3), 2.8);
    EXPECT_EQ(steppedStop(8, -3), 5.6);
    EXPECT_EQ(steppedStop(8, 0), 8);
}

TEST(PhotographicStops, fromBetweenTwoStopsTheFirstStepGoesToTheNeighbour) {
    EXPECT_EQ(steppedStop(3.0, 1), 3.2);
    EXPECT_EQ(steppedStop(3.0, -1), 2.8);
    EXPECT_EQ(steppedStop(3.0, 2), 3.5);
}

TEST(PhotographicStops, endAtTheEndsOfTheRing) {
    EXPECT_EQ(steppedStop(64, 5), 64);
    EXPECT_EQ(steppedStop(0.7, -5), 0.7);
    EXPECT_EQ(steppedStop(1000, -1), 64);
    EXPECT_EQ(steppedStop(0.01, 1), 0.7);
}

}  // namespace
}  // namespace defocus::engine
