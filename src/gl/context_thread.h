#pragma once
// Thread with an OpenGL context of its own, which shares buffers, textures, programs and fences with another context.
// Vertex arrays, targets and timers are not shared: a task must create, use and destroy them on this thread.

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include "gl/context.h"

namespace defocus::engine {

class ContextThread {
public:
    // `context` must not be current on any thread. Throws Error if it cannot become current on the new thread.
    explicit ContextThread(std::unique_ptr<GlContext> context);
    // Waits for the running task and discards the tasks that have not started.
    ~ContextThread();
    ContextThread(const ContextThread&) = delete;
    ContextThread& operator=(const ContextThread&) = delete;

    // Runs `task` on this thread, after all earlier tasks. The returned future gives the task's result or rethrows its
    // exception. If the task is discarded, the future throws std::future_error.
    template <typename Task>
    std::future<std::invoke_result_t<Task>> add(Task task) {
        std::packaged_task<std::invoke_result_t<Task>()> packaged(std::move(task));
        auto result = packaged.get_future();
        push(std::packaged_task<void()>([run = std::move(packaged)]() mutable { run(); }));
        return result;
    }

private:
    void push(std::packaged_task<void()> task);
    void work(std::promise<void> started);

    std::unique_ptr<GlContext> context_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::packaged_task<void()>> tasks_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace defocus::engine
