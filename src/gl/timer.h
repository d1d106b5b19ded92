#pragma once
// Measures GPU time with pairs of GL_TIMESTAMP queries, because llvmpipe's GL_TIME_ELAPSED is wrong by orders of
// magnitude. With software drivers, the time excludes vertex processing.

#include <vector>

#include "gl/handle.h"

namespace defocus::engine {

// Waits until the GPU has executed all commands of the current context.
void waitForGpu();

class GpuTimer {
public:
    void begin();
    void end();
    // Measures the GPU time of the commands that `pass` issues.
    void measure(const auto& pass) {
        begin();
        pass();
        end();
    }
    // Waits for the GPU. Returns the total of all begin–end spans since the last reset.
    [[nodiscard]] double milliseconds();
    void reset();

private:
    std::vector<GlHandle<destroyQuery>> pending_;  // alternating begin and end queries
    double total_ = 0;
};

}  // namespace defocus::engine
