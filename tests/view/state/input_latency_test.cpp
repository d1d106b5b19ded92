#include "view/state/input_latency.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

InputLatency::Time at(int milliseconds) {
    return InputLatency::Time() + std::chrono::milliseconds(milliseconds);
}

TEST(InputLatency, countsFromTheEarliestEventToTheFrameThatAnswers) {
    InputLatency latency;
    EXPECT_EQ(latency.summary().count, 0u);
    latency.arrived(at(100));
    latency.arrived(at(120));  // a second input while the first is still pending
    latency.shown(at(150));
    latency.shown(at(400));  // a frame without a pending input
    EXPECT_EQ(latency.summary().count, 1u);
    EXPECT_DOUBLE_EQ(latency.summary().latest, 50);
    for (const int wait : {10, 30, 20, 400}) {
        latency.arrived(at(1000));
        latency.shown(at(1000 + wait));
    }
    EXPECT_DOUBLE_EQ(latency.summary().median, 30);
    EXPECT_DOUBLE_EQ(latency.summary().worst, 400);
    EXPECT_DOUBLE_EQ(latency.summary().latest, 400);
}

TEST(InputLatency, whatChangesNothingIsNotCounted) {
    InputLatency latency;
    latency.arrived(at(0));
    latency.forget();
    latency.shown(at(5000));
    EXPECT_EQ(latency.summary().count, 0u);
}

}  // namespace
}  // namespace defocus::engine
