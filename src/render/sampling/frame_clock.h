#pragma once
// The times of a frame for RenderStats: wall-clock time of setup and frame, measured with the GPU idle, and timer
// queries of waves.

#include <chrono>

#include "gl/timer.h"
#include "render/renderer.h"

namespace defocus::engine {

class FrameClock {
public:
    // Discards the times of the previous frame.
    void beginSetup();
    // Ends the setup and begins the frame; waits for the GPU.
    void beginFrame();
    void beginWave() { timer_.begin(); }
    void endWave() { timer_.end(); }
    // Ends the frame; waits for the GPU.
    void endFrame();

    // Fills in times, device and driver. Unfinished times are 0.
    void fill(RenderStats& stats);

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_;
    double setupMilliseconds_ = 0;
    double renderMilliseconds_ = 0;
    GpuTimer timer_;
};

}  // namespace defocus::engine
