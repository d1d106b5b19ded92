#include "render/accumulation/wave_queue.h"

#include <algorithm>
#include <utility>

namespace defocus::engine {

// A WaveDrawer and the thread that owns its OpenGL context. Without a thread, tasks run immediately in the caller's
// context.
class WaveQueue::Lane {
public:
    Lane(std::unique_ptr<ContextThread> thread, const GpuScene& scene, const Occlusion& occlusion,
         const RendererOptions& options, std::uint64_t pendingBytes)
        : thread_(std::move(thread)) {
        run([&] { drawer_.emplace(scene, occlusion, options, pendingBytes); }).get();
    }
    ~Lane() {
        run([&] { drawer_.reset(); }).wait();
    }
    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;

    template <typename Task>
    std::future<std::invoke_result_t<Task>> run(Task task) {
        if (thread_) return thread_->add(std::move(task));
        std::packaged_task<std::invoke_result_t<Task>()> packaged(std::move(task));
        packaged();
        return packaged.get_future();
    }
    // Returns the drawer. Only tasks of run() may use it, except for its layers (targets), which other code may use,
    // too.
    [[nodiscard]] WaveDrawer& drawer() { return *drawer_; }
    [[nodiscard]] bool hasThread() const { return thread_ != nullptr; }

private:
    std::unique_ptr<ContextThread> thread_;
    std::optional<WaveDrawer> drawer_;
};

namespace {

// Waits for all futures, then returns their values. Rethrows the first exception.
template <typename Value>
std::vector<Value> valuesOf(std::vector<std::future<Value>>& futures) {
    for (const auto& future : futures) future.wait();
    std::vector<Value> values;
    values.reserve(futures.size());
    for (auto& future : futures) values.push_back(future.get());
    return values;
}

}  // namespace

WaveQueue::WaveQueue(const GpuScene& scene, const RendererOptions& options)
    : scene_(&scene), options_(options), occlusion_(scene.world()) {}

WaveQueue::~WaveQueue() {
    stop();
}

// Creates lanes (WaveDrawers) until there are `threads` of them, each with a thread and an OpenGL context of its own.
// Creates only one lane, in the caller's context, if `threads` is 1 or contexts cannot share objects.
void WaveQueue::makeLanes(std::uint32_t threads) {
    const bool several = threads > 1;
    if (several != severalContexts_) lanes_.clear();
    severalContexts_ = several;
    while (lanes_.size() < threads && (lanes_.empty() || lanes_.back()->hasThread())) {
        std::unique_ptr<GlContext> context = several ? createSharedContext() : nullptr;
        auto thread = context ? std::make_unique<ContextThread>(std::move(context)) : nullptr;
        const std::uint64_t pendingBytes = options_.pendingBytes / (several ? options_.threads : 1);
        lanes_.push_back(std::make_unique<Lane>(std::move(thread), *scene_, occlusion_, options_, pendingBytes));
    }
    active_ = static_cast<std::uint32_t>(std::min<std::size_t>(lanes_.size(), threads));
}

void WaveQueue::prepare(const WaveFrame& frame, const WaveShape& shape) {
    stop();
    makeLanes(shape.threads);
    frame_ = frame;
    shape_ = shape;
    started_ = returned_ = 0;
    abandoned_ = std::make_shared<std::atomic<bool>>(false);
    places_ = std::vector<Place>(std::size_t{active_} * shape.targets);
    if (lanes_.front()->hasThread()) waitForGpu();  // finish uploads before other contexts read the scene's buffers
    std::vector<std::future<std::size_t>> prepared;
    for (std::size_t i = 0; i < lanes_.size(); ++i)
        prepared.push_back(lanes_[i]->run([&drawer = lanes_[i]->drawer(), &frame, &shape, used = i < active_] {
            if (used)
                drawer.prepare(frame, shape.targets);
            else
                drawer.freeTargets();
            return drawer.bytes();
        }));
    bytes_ = 0;
    for (const std::size_t bytes : valuesOf(prepared)) bytes_ += bytes;
    Lane& first = *lanes_.front();
    if (frame.skipsHidden)
        occlusion_.prepare(*frame.plan, first.run([&] { return first.drawer().opaqueDraws(); }).get());
}

void WaveQueue::stop() {
    if (abandoned_) *abandoned_ = true;
    for (Place& place : places_)
        if (place.drawn.valid()) place.drawn.wait();
    places_.clear();
    blockVisibility_ = {};
}

DrawnWave WaveQueue::next() {
    const auto samples = static_cast<std::uint32_t>(frame_.plan->samples.size());
    const auto places = static_cast<std::uint32_t>(places_.size());
    if (returned_ > 0 && lanes_.front()->hasThread())
        places_[(returned_ - 1) % places].summed = Fence::forOtherContexts();
    while (started_ * shape_.samples < samples && started_ < returned_ + places) draw(started_++);
    const std::uint32_t wave = returned_++;
    const Drawn drawn = places_[wave % places].drawn.get();
    drawn.complete.wait();
    const std::uint32_t first = wave * shape_.samples;
    return {first, std::min(shape_.samples, samples - first), drawn.hiddenTriangles,
            &laneOf(wave).drawer().target(wave % places / active_)};
}

// Passes batch (wave) number `wave` of the frame's samples to the thread that draws it.
void WaveQueue::draw(std::uint32_t wave) {
    const std::uint32_t first = wave * shape_.samples;
    const std::uint32_t count =
        std::min(shape_.samples, static_cast<std::uint32_t>(frame_.plan->samples.size()) - first);
    const std::size_t place = wave % places_.size();
    Lane& lane = laneOf(wave);
    places_[place].drawn =
        lane.run([&drawer = lane.drawer(), first, count, target = place / active_,
                  summed = std::exchange(places_[place].summed, {}), visibility = visibilityFor(first),
                  abandoned = abandoned_, isShared = lane.hasThread()]() mutable -> Drawn {
            if (*abandoned) return {};
            summed.wait();
            const std::uint64_t hidden = drawer.draw(first, count, target, std::move(visibility));
            return {hidden, isShared ? Fence::forOtherContexts() : Fence()};
        });
}

// Returns the WaveVisibility of the batch (wave) whose first sample is `firstSample`. With this object, a block's first
// batch tells the block's other batches which triangles are hidden. Must be called with ascending `firstSample`.
WaveVisibility WaveQueue::visibilityFor(std::uint32_t firstSample) {
    if (firstSample % blockSamples != 0) return {{}, blockVisibility_};
    std::promise<WaveVisibility::Value> made;
    blockVisibility_ = made.get_future().share();
    return {std::move(made), blockVisibility_};
}

std::vector<PassTime> WaveQueue::times() {
    std::vector<std::future<std::vector<PassTime>>> ofLanes;
    for (std::size_t i = 0; i < active_; ++i)
        ofLanes.push_back(lanes_[i]->run([&drawer = lanes_[i]->drawer()] { return drawer.times(); }));
    std::vector<PassTime> total;
    for (const std::vector<PassTime>& times : valuesOf(ofLanes)) {
        total.resize(times.size());
        for (std::size_t i = 0; i < times.size(); ++i) {
            total[i].name = times[i].name;
            total[i].milliseconds += times[i].milliseconds;
        }
    }
    return total;
}

void WaveQueue::resetTimes() {
    for (const auto& lane : lanes_) lane->run([&drawer = lane->drawer()] { drawer.resetTimes(); }).get();
}

}  // namespace defocus::engine
