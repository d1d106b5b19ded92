#pragma once
// Draws the samples of a frame in batches (waves), in the caller's OpenGL context or in several threads with contexts
// of their own, and returns the batches in the order of their samples. Software drivers process vertices in the thread
// that calls OpenGL, so several threads use more cores. The layers of a batch do not depend on the thread that draws
// it.

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <vector>

#include "gl/context_thread.h"
#include "gl/fence.h"
#include "render/accumulation/wave_drawer.h"

namespace defocus::engine {

// Number of threads, number of batches (waves) of samples in memory, and number of samples per batch.
struct WaveShape {
    std::uint32_t threads = 1;  // number of threads that draw; 1: only the caller's thread
    std::uint32_t targets = 1;  // batches in memory per thread; with 2, one batch is drawn while the other is summed
    std::uint32_t samples = 1;  // samples per batch, a power of two, at most blockSamples
    [[nodiscard]] std::uint32_t waves() const { return threads * targets; }
};

struct DrawnWave {
    std::uint32_t first = 0;  // index of the batch's first sample in FramePlan::samples
    std::uint32_t count = 0;
    std::uint64_t hiddenTriangles = 0;  // triangles that were skipped because they are hidden
    const WaveTargets* layers = nullptr;
};

class WaveQueue {
public:
    // `scene` must outlive this object. All calls need the OpenGL context that was current during construction.
    WaveQueue(const GpuScene& scene, const RendererOptions& options);
    ~WaveQueue();
    WaveQueue(const WaveQueue&) = delete;
    WaveQueue& operator=(const WaveQueue&) = delete;

    // Abandons the batches (waves) of the previous frame and prepares those of `frame`, whose data must be in the
    // scene's buffers and textures.
    void prepare(const WaveFrame& frame, const WaveShape& shape);
    // Returns the next batch (wave), at most `shape.samples` samples of one block. The batch's layers can be read in
    // the current context until the next call. The plan must have samples left. Throws Error if a thread failed.
    DrawnWave next();
    // Abandons the batches (waves) that next() has not yet returned.
    void stop();

    // Returns GPU times of the frame's passes, summed over all threads. Waits for the batches that are being drawn.
    [[nodiscard]] std::vector<PassTime> times();
    void resetTimes();
    // Returns the bytes of graphics memory that all threads use. Needs a prepared frame.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint32_t threads() const { return active_; }  // number of threads that draw the frame
    // Returns the number of layers in use by all threads.
    [[nodiscard]] std::uint32_t layers() const { return active_ * shape_.targets * shape_.samples; }

private:
    class Lane;
    struct Drawn {
        std::uint64_t hiddenTriangles = 0;
        Fence complete;
    };
    // State of a batch (wave). Batch number w of a frame uses places_[w mod places_.size()].
    struct Place {
        std::future<Drawn> drawn;
        Fence summed;  // complete when the layers have been summed and may be overwritten
    };

    void makeLanes(std::uint32_t threads);
    void draw(std::uint32_t wave);
    [[nodiscard]] WaveVisibility visibilityFor(std::uint32_t firstSample);
    [[nodiscard]] Lane& laneOf(std::uint32_t wave) { return *lanes_[wave % active_]; }

    const GpuScene* scene_;
    RendererOptions options_;
    Occlusion occlusion_;
    std::vector<std::unique_ptr<Lane>> lanes_;
    std::uint32_t active_ = 0;      // number of elements of lanes_ that the frame uses
    bool severalContexts_ = false;  // true: each lane (WaveDrawer) has a thread and a context
    WaveFrame frame_;
    WaveShape shape_;
    std::vector<Place> places_;
    std::uint32_t started_ = 0;   // number of batches that were passed to threads
    std::uint32_t returned_ = 0;  // number of batches that next() has returned
    // Visible triangles, found by the occlusion test for the block of 64 samples that contains the latest batch.
    std::shared_future<WaveVisibility::Value> blockVisibility_;
    // Set when the remaining batches of samples are not needed.
    std::shared_ptr<std::atomic<bool>> abandoned_;
    std::size_t bytes_ = 0;
};

}  // namespace defocus::engine
