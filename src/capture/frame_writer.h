#pragma once
// Encodes and writes frames on a separate thread, so that the renderer doesn't wait for EXR compression. Frames wait in
// a bounded queue. A file gets its final name only when it is complete.

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
    // `waiting`: max number of jobs that wait in the queue, ≥ 1.
    explicit FrameWriter(std::size_t waiting);
    // Blocks until all queued jobs are done, unless a job has failed.
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    // Queues a job that writes a frame; blocks while the queue is full. Rethrows the exception of a failed job. After a
    // failure, no further job runs.
    void add(std::function<void()> job);
    // Blocks until all jobs are done. Rethrows the exception of a failed job.
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
