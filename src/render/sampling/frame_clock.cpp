#include "render/sampling/frame_clock.h"

#include <epoxy/gl.h>

#include "core/stopwatch.h"
#include "gl/context.h"

namespace defocus::engine {

void FrameClock::beginSetup() {
    setupMilliseconds_ = 0;
    renderMilliseconds_ = 0;
    timer_.reset();
    begin_ = Clock::now();
}

void FrameClock::beginFrame() {
    glFinish();
    setupMilliseconds_ = millisecondsSince(begin_);
    begin_ = Clock::now();
}

void FrameClock::endFrame() {
    glFinish();
    renderMilliseconds_ = millisecondsSince(begin_);
}

void FrameClock::fill(RenderStats& stats) {
    stats.setupMilliseconds = setupMilliseconds_;
    stats.renderMilliseconds = renderMilliseconds_;
    stats.gpuMilliseconds = timer_.milliseconds();
    stats.device = currentDevice();
    stats.driver = currentDriver();
}

}  // namespace defocus::engine
