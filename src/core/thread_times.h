#pragma once
// Measures the CPU times of this process's threads.

#include <map>

namespace defocus::engine {

// CPU time that was used during an interval, in ms; 0 if the system does not report the times of threads.
struct CpuTime {
    double milliseconds = 0;         // CPU time of all threads
    double busiestMilliseconds = 0;  // CPU time of the thread that used the most
    CpuTime& operator+=(const CpuTime& other) {
        milliseconds += other.milliseconds;
        busiestMilliseconds += other.busiestMilliseconds;
        return *this;
    }
};

class CpuClock {
public:
    // Begins the interval that elapsed() measures.
    void start();
    // Returns the CPU time since start(). Threads that have ended are not counted.
    [[nodiscard]] CpuTime elapsed() const;

private:
    std::map<int, double> before_;  // thread ID → CPU time in ms at start()
};

}  // namespace defocus::engine
