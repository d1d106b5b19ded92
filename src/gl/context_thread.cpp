#include "gl/context_thread.h"

namespace defocus::engine {

ContextThread::ContextThread(std::unique_ptr<GlContext> context) : context_(std::move(context)) {
    std::promise<void> started;
    std::future<void> start = started.get_future();
    thread_ = std::thread([this, promise = std::move(started)]() mutable { work(std::move(promise)); });
    try {
        start.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

ContextThread::~ContextThread() {
    {
        const std::scoped_lock lock(mutex_);
        ends_ = true;
        tasks_.clear();
    }
    changed_.notify_one();
    thread_.join();
}

void ContextThread::push(std::packaged_task<void()> task) {
    {
        const std::scoped_lock lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
}

void ContextThread::work(std::promise<void> started) {
    try {
        context_->makeCurrent();
    } catch (...) {
        return started.set_exception(std::current_exception());
    }
    started.set_value();
    for (std::unique_lock lock(mutex_);;) {
        changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
        if (tasks_.empty()) break;
        std::packaged_task<void()> task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        task = {};  // destroy the task's captures now, because a task on another thread may wait for their destruction
        lock.lock();
    }
    context_.reset();  // destroy the context on this thread, where it is current
}

}  // namespace defocus::engine
