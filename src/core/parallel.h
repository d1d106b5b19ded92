#pragma once
// Work on several cores, by oneTBB: however deep it nests, no more threads work than the process may use cores.
// Results must not depend on the order.

#include <cstddef>
#include <functional>
#include <memory>

namespace defocus::engine {

// Runs body(0) … body(count - 1) on all cores, each index once; returns when all are done. Indices are begun in their
// order: what costs most is best put first. The first exception of a body is thrown again in the caller. Bodies may
// call it in their turn; one that waits there begins no further index of its own loop.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

// Work that comes up one piece after the other, done by threads beside the one that finds it.
class Tasks {
public:
    explicit Tasks(std::size_t workers);  // at most, and of the cores; 0: add() does the work itself
    ~Tasks();                             // drops what nobody waited for
    Tasks(const Tasks&) = delete;
    Tasks& operator=(const Tasks&) = delete;

    void add(std::function<void()> task);
    // Helps until all is done. Throws the first exception of a task again.
    void wait();

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;  // none without workers
};

}  // namespace defocus::engine
