#pragma once
// GPU time between pairs of GL_TIMESTAMP queries; llvmpipe's GL_TIME_ELAPSED is wrong by orders of magnitude. Software
// drivers omit vertex work from these timestamps.

#include <vector>

#include "gl/handle.h"

namespace defocus::engine {

class GpuTimer {
public:
    void begin();
    void end();
    // Returns the milliseconds of all begin–end spans since the last reset; waits for the GPU.
    [[nodiscard]] double milliseconds();
    void reset();

private:
    std::vector<GlHandle<destroyQuery>> pending_;  // alternating begin and end queries
    double total_ = 0;
};

}  // namespace defocus::engine
