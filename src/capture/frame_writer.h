#pragma once
// Encodes and writes frames on a separate thread, so that the renderer doesn't wait for EXR compression. Frames wait in
// a bounded queue. A file gets its name only when it is complete.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace defocus::engine {

class FrameWriter {
public:
    // `waiting`: maximum number of jobs in the queue, ≥ 1.
    explicit FrameWriter(std::size_t waiting);
    // Waits for the queued jobs, unless a job has failed.
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    // Queues a job that writes a frame, and waits while the queue is full. Rethrows the exception of a failed job; no
    // further job runs after a failure.
    void add(std::function<void()> job);
    // Waits until all jobs are done. Rethrows the exception of a failed job.
    void finish();

private:
    void run();

    std::size_t max_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    bool busy_ = false;
    bool closing_ = false;
    std::exception_ptr fault_;
    std::thread thread_;
};

}  // namespace defocus::engine
