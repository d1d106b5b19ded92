#pragma once
// Work on several cores. Results must not depend on the order.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace defocus {

// Runs body(0) … body(count - 1) on all cores, each index once, in no set order; returns when all are done. The first
// exception of a body is thrown again in the caller.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

// Work that comes up one piece after the other, done by threads beside the one that finds it.
class Tasks {
public:
    explicit Tasks(std::size_t workers);  // 0: add() does the work itself
    ~Tasks();                             // drops what nobody waited for
    Tasks(const Tasks&) = delete;
    Tasks& operator=(const Tasks&) = delete;

    void add(std::function<void()> task);
    // Helps until all is done. Throws the first exception of a task again.
    void wait();

private:
    void work(bool untilStopped);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> pending_;
    std::size_t running_ = 0;
    bool stopped_ = false;
    std::exception_ptr failure_;
    std::vector<std::jthread> threads_;
};

}  // namespace defocus
