#pragma once
// The times of a frame as RenderStats has them: set-up and frame by wall clock between finished GPU work, waves by
// timer queries.

#include <chrono>

#include "gl/timer.h"
#include "render/renderer.h"

namespace defocus::engine {

class FrameClock {
public:
    // Forgets the frame before.
    void beginSetup();
    // Set-up ends and the frame begins; waits for the GPU.
    void beginFrame();
    void beginWave() { timer_.begin(); }
    void endWave() { timer_.end(); }
    // Waits for the GPU.
    void endFrame();

    // Times, device and driver; 0 for what isn't over yet.
    void fill(RenderStats& stats);

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_;
    double setupMilliseconds_ = 0;
    double renderMilliseconds_ = 0;
    GpuTimer timer_;
};

}  // namespace defocus::engine
