#include "render/sampling/frame_clock.h"

#include <epoxy/gl.h>

#include "core/stopwatch.h"
#include "gl/context.h"

namespace defocus::engine {

void FrameClock::beginSetup() {
    setupMilliseconds_ = 0;
    renderMilliseconds_ = 0;
    cpuTime_ = {};
    timer_.reset();
    begin_ = Clock::now();
}

void FrameClock::beginFrame() {
    glFinish();
    setupMilliseconds_ = millisecondsSince(begin_);
    cpuClock_.start();
    begin_ = Clock::now();
}

void FrameClock::endFrame() {
    glFinish();
    renderMilliseconds_ = millisecondsSince(begin_);
    cpuTime_ = cpuClock_.elapsed();
}

void FrameClock::fill(RenderStats& stats) {
    stats.setupMilliseconds = setupMilliseconds_;
    stats.renderMilliseconds = renderMilliseconds_;
    stats.cpuTime = cpuTime_;
    stats.gpuMilliseconds = timer_.milliseconds();
    stats.device = currentDevice();
    stats.driver = currentDriver();
}

}  // namespace defocus::engine
