#include "capture/frame_writer.h"

#include <utility>

namespace defocus::engine {

FrameWriter::FrameWriter(std::size_t waiting) : max_(waiting), thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void FrameWriter::add(std::function<void()> job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return fault_ || jobs_.size() < max_; });
    if (fault_) std::rethrow_exception(fault_);
    jobs_.push_back(std::move(job));
    changed_.notify_all();
}

void FrameWriter::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return fault_ || (jobs_.empty() && !busy_); });
    if (fault_) std::rethrow_exception(fault_);
}

void FrameWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        const std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        busy_ = true;
        changed_.notify_all();
        lock.unlock();
        std::exception_ptr fault;
        try {
            job();
        } catch (...) {
            fault = std::current_exception();
        }
        lock.lock();
        busy_ = false;
        fault_ = fault;
        changed_.notify_all();
        if (fault_) return;
    }
}

}  // namespace defocus::engine
