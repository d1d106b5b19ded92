#pragma once
// Encodes and writes frames on a thread of its own, so that the renderer doesn't wait for EXR's compression. Frames
// wait in a bounded queue; a file appears whole under its name or not at all.

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
    // At most `waiting` jobs in the queue, ≥ 1.
    explicit FrameWriter(std::size_t waiting);
    // Waits for what is in the queue, unless a job has failed.
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    // Queues a job that writes a frame; waits while the queue is full. Throws what an earlier job threw: none after it
    // is run.
    void add(std::function<void()> job);
    // Waits until all is written. Throws what a job threw.
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
