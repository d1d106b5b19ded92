#pragma once
// CPU times of the threads of this process.

#include <map>

namespace defocus::engine {

// CPU time of an interval, in ms; 0 if the system does not report the times of threads.
struct CpuTime {
    double milliseconds = 0;         // CPU time of all threads
    double busiestMilliseconds = 0;  // CPU time of the thread with the largest time
    CpuTime& operator+=(const CpuTime& other) {
        milliseconds += other.milliseconds;
        busiestMilliseconds += other.busiestMilliseconds;
        return *this;
    }
};

class CpuClock {
public:
    // Begins the interval.
    void start();
    // Returns the CPU time since start(). Threads that have ended are not counted.
    [[nodiscard]] CpuTime elapsed() const;

private:
    std::map<int, double> before_;  // key: thread ID; CPU time in ms
};

}  // namespace defocus::engine
