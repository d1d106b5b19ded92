#pragma once
// GPU time of a span of GL commands between pairs of GL_TIMESTAMP queries (llvmpipe's GL_TIME_ELAPSED is
// off by orders of magnitude). On a software driver these miss the vertex work.

#include <vector>

#include "gl/handle.h"

namespace defocus::engine {

class GpuTimer {
public:
    void begin();
    void end();
    // Milliseconds over all spans since the last reset; waits for the GPU.
    [[nodiscard]] double milliseconds();
    void reset();

private:
    std::vector<GlHandle<destroyQuery>> pending_;  // begin, end, begin, end …
    double total_ = 0;
};

}  // namespace defocus::engine
