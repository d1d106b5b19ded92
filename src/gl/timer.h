#pragma once
// GPU time of a span of GL commands through GL_TIME_ELAPSED queries. On a software driver these miss the vertex work.

#include <vector>

#include "gl/handle.h"

namespace defocus {

class GpuTimer {
public:
    void begin();
    void end();
    // Milliseconds over all spans since the last reset; waits for the GPU.
    [[nodiscard]] double milliseconds();
    void reset();

private:
    std::vector<GlHandle<destroyQuery>> pending_;
    double total_ = 0;
};

}  // namespace defocus
