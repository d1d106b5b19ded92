#include <chrono>

#include "gl/gl_test.h"
#include "gl/timer.h"

namespace defocus::engine {
namespace {

using Timer = GlTest;

// Records one span of the timer: busy waiting for at least `milliseconds` of wall-clock time.
void spanOf(GpuTimer& timer, double milliseconds) {
    using Clock = std::chrono::steady_clock;
    timer.begin();
    glFinish();
    for (const auto start = Clock::now();
         Clock::now() - start < std::chrono::duration<double, std::milli>(milliseconds);) {
    }
    timer.end();
}

TEST_F(Timer, withoutSpansIsZero) {
    GpuTimer timer;
    EXPECT_EQ(timer.milliseconds(), 0);
    timer.begin();
    EXPECT_EQ(timer.milliseconds(), 0) << "an unfinished span counts as zero";
}

TEST_F(Timer, sumsItsSpansUntilItIsReset) {
    GpuTimer timer;
    spanOf(timer, 8);
    const double first = timer.milliseconds();
    EXPECT_GE(first, 4);  // at least half of the 8 ms on the CPU's clock, since the GPU's clock differs
    EXPECT_EQ(timer.milliseconds(), first) << "reading adds no time";
    spanOf(timer, 8);
    spanOf(timer, 8);
    EXPECT_GE(timer.milliseconds(), first + 8);
    timer.reset();
    EXPECT_EQ(timer.milliseconds(), 0);
    spanOf(timer, 1);
    timer.reset();  // also discards spans whose times were not read
    EXPECT_EQ(timer.milliseconds(), 0);
}

// A timer excludes the time between its spans. The timer `all`, which runs without a break, includes that time.
TEST_F(Timer, leavesOutWhatLiesBetween) {
    GpuTimer all, two, between;
    all.begin();
    spanOf(two, 1);
    spanOf(between, 10);
    spanOf(two, 1);
    all.end();
    EXPECT_LE(two.milliseconds() + between.milliseconds(), all.milliseconds() + 1e-3);
}

}  // namespace
}  // namespace defocus::engine
