#pragma once
// Measures the times of a frame for RenderStats: wall-clock times of setup and drawing, each including the wait for the
// GPU; CPU times of drawing; and GPU times between beginWave() and endWave().

#include <chrono>

#include "core/thread_times.h"
#include "gl/timer.h"
#include "render/renderer.h"

namespace defocus::engine {

class FrameClock {
public:
    // Starts the timing of the setup; discards the times of the previous frame.
    void beginSetup();
    // Waits for the GPU, then ends the timing of the setup and starts the timing of the drawing.
    void beginFrame();
    void beginWave() { timer_.begin(); }
    void endWave() { timer_.end(); }
    // Waits until the GPU has drawn the frame, then ends the timing.
    void endFrame();

    // Sets times, device and driver of `stats`. Times of unfinished intervals are 0.
    void fill(RenderStats& stats);

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_;
    double setupMilliseconds_ = 0;
    double renderMilliseconds_ = 0;
    CpuClock cpuClock_;
    CpuTime cpuTime_;  // CPU time of drawing
    GpuTimer timer_;
};

}  // namespace defocus::engine
