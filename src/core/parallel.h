#pragma once
// Runs loops and tasks in parallel with oneTBB. Nested calls never use more threads than there are cores available to
// the process. Results must not depend on the execution order.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace defocus::engine {

// Returns the number of cores available to the process.
std::uint32_t availableCores();

// Runs body(0) … body(count - 1) on all cores and returns when all are done. Indices start in order, so put the most
// expensive bodies first. Rethrows the first exception of a body. Bodies may call parallelFor; a thread that waits for
// the inner loop runs no bodies of the outer loop.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

// Runs tasks on other threads while the caller adds more tasks.
class Tasks {
public:
    explicit Tasks(std::size_t workers);  // max threads, at most one per core; 0: add() runs each task itself
    ~Tasks();                             // cancels tasks that have not started
    Tasks(const Tasks&) = delete;
    Tasks& operator=(const Tasks&) = delete;

    void add(std::function<void()> task);
    // Blocks until all tasks are done; the calling thread also runs tasks. Rethrows the first exception of a task.
    void wait();

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;  // oneTBB task arena of the workers; nullptr without workers
};

}  // namespace defocus::engine
