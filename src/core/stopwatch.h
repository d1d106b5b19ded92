#pragma once
// Measures elapsed wall-clock time.

#include <chrono>

namespace defocus::engine {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace defocus::engine
