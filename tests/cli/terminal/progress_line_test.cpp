#include "cli/terminal/progress_line.h"

#include <gtest/gtest.h>

#include <string>

namespace defocus::engine {
namespace {

TEST(ProgressLine, fitsEveryTerminal) {
    for (const std::string stage : {"samples", "frame 1234, 3400 ms and 18.20 M triangles per frame"})
        for (int columns = 1; columns < 240; ++columns)
            for (const double share : {0.0, 0.004, 0.5, 1.0})
                EXPECT_LT(static_cast<int>(progressLine(stage, share, 3599, columns).size()), std::max(columns, 2))
                    << stage << " in " << columns;
}

TEST(ProgressLine, narrowTerminalsShowTheShareFirst) {
    EXPECT_EQ(progressLine("samples", 0.5, 12, 60), "samples [#############--------------]  50 %, 12 s left");
    EXPECT_EQ(progressLine("frame 3, 9 ms each", 0.5, 12, 45), "frame 3, 9 ms each 50 %, 12 s left");
    EXPECT_EQ(progressLine("frame 3, 9 ms each", 0.5, 12, 30), "frame 50 %, 12 s left");
    EXPECT_EQ(progressLine("frame 3, 9 ms each", 0.5, 12, 12), "frame 50 %");
    EXPECT_EQ(progressLine("frame 3, 9 ms each", 0.5, 12, 6), "50 %");
    EXPECT_EQ(progressLine("samples", 0.5, {}, 30), "samples 50 %");
}

TEST(TimeLeft, followsThePaceOfAStage) {
    TimeLeft time;
    EXPECT_FALSE(time.after("samples", 0, 100));
    EXPECT_FALSE(time.after("samples", 0.5, 100.5)) << "too early to tell";
    EXPECT_FALSE(time.after("samples", 0.25, 110)) << "a smaller share restarts the estimate";
    EXPECT_NEAR(time.after("samples", 0.5, 120).value(), 20, 1e-9);
    EXPECT_FALSE(time.after("pyramids", 0.1, 130)) << "another stage";
    EXPECT_NEAR(time.after("pyramids", 0.2, 140).value(), 80, 1e-9);
}

TEST(TimeLeft, takesTheFramesOfAFilmAsOneStage) {
    TimeLeft time;
    EXPECT_FALSE(time.after("frame 0", 0, 0));
    EXPECT_NEAR(time.after("frame 7, 900 ms each", 0.5, 10).value(), 10, 1e-9);
}

}  // namespace
}  // namespace defocus::engine
