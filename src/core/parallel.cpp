#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace defocus {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                body(i);
            } catch (...) {
                const std::scoped_lock lock(failureMutex);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    };
    const std::size_t workers = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < workers; ++i) threads.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

Tasks::Tasks(std::size_t workers) {
    for (std::size_t i = 0; i < workers; ++i) threads_.emplace_back([this] { work(true); });
}

Tasks::~Tasks() {
    {
        const std::scoped_lock lock(mutex_);
        stopped_ = true;
        pending_.clear();
    }
    changed_.notify_all();
}

void Tasks::add(std::function<void()> task) {
    if (threads_.empty()) return task();
    {
        const std::scoped_lock lock(mutex_);
        pending_.push_back(std::move(task));
    }
    changed_.notify_all();
}

void Tasks::wait() {
    work(false);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Tasks::work(bool untilStopped) {
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto done = [&] { return untilStopped ? stopped_ : running_ == 0; };
        changed_.wait(lock, [&] { return !pending_.empty() || done(); });
        if (pending_.empty()) return;
        std::function<void()> task = std::move(pending_.front());
        pending_.pop_front();
        ++running_;
        lock.unlock();
        std::exception_ptr failure;
        try {
            task();
        } catch (...) {
            failure = std::current_exception();
        }
        task = {};
        lock.lock();
        if (failure && !failure_) failure_ = failure;
        --running_;
        changed_.notify_all();
    }
}

}  // namespace defocus
