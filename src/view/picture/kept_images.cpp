#include "view/picture/kept_images.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "core/memory_limits.h"
#include "core/stopwatch.h"
#include "gl/device_memory.h"
#include "gl/timer.h"
#include "plan/sample_range.h"
#include "refocus/kept_lens_images.h"
#include "render/accumulation/accumulation.h"

namespace defocus::engine {

namespace {

// Returns `bytes`, or a quarter of the free memory if that is less.
std::uint64_t withinFreeMemory(std::uint64_t bytes) {
    const std::uint64_t free = freeDeviceMemory().value_or(freeMemory());
    return free > 0 ? std::min(bytes, free / 4) : bytes;
}

// Returns the number of lens images (images of single lens samples) that fit into `bytes`. Throws Error if fewer than
// minImages fit.
std::uint32_t fittingImages(const PartSize& size, std::uint64_t bytes) {
    const std::uint64_t fitting = bytes / KeptLensImages::bytes(size, 1);
    if (fitting < KeptImages::minImages)
        fail("{} lens images of {} x {} px need {} of memory, but the window may use only {}; make the window smaller",
             KeptImages::minImages, size.fullWidth(), size.fullHeight(),
             bytesText(KeptLensImages::bytes(size, KeptImages::minImages)), bytesText(bytes));
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(fitting, KeptImages::maxImages));
}

}  // namespace

FocusRange keptRange(const View& view, const FramePlan& plan) {
    const double own = view.lens.focusDistance;
    FocusRange range{own, own};
    for (const ObjectPlan& object : plan.objects) {
        range.nearest = std::min(range.nearest, std::max(object.nearestDepth, view.nearPlane));
        range.farthest = std::max(range.farthest, object.farthestDepth);
    }
    const double maxMove = std::max(view.width, view.height) / 8.0;  // max shift of a lens image, px
    const double dioptres = maxMove / lightFieldInfo(view, {own, own}).pixelsPerDioptre;
    range.nearest = std::max(range.nearest, 1 / (1 / own + dioptres));
    if (1 / own > dioptres) range.farthest = std::min(range.farthest, 1 / (1 / own - dioptres));
    return range;
}

KeptImages::KeptImages(const World& world, RendererOptions options, bool software)
    : world_(&world), options_(std::move(options)), stack_(options_.shaderFolder, software) {
    options_.wave = 1;
}

void KeptImages::begin(const View& view, const RenderSettings& settings, const FramePlan& plan, std::uint64_t bytes) {
    discard();
    try {
        info_ = lightFieldInfo(view, keptRange(view, plan));
        RenderSettings drawn = settings;
        drawn.refocus = info_.range;
        drawn.positions = 1;
        drawn.sampleCount = fittingImages(info_.size, withinFreeMemory(bytes));
        plan_ = planFrame(*world_, withMargin(view, info_.size.margin), drawn);
        addSamples(info_, plan_);
    } catch (const Error& error) {
        discard();
        obstacle_ = error.what();
    }
}

void KeptImages::discard() {
    plan_ = {};
    info_ = {};
    drawn_ = 0;
    obstacle_.clear();
    stack_.free();
    renderer_.reset();
}

bool KeptImages::grow(double milliseconds) {
    const Clock::time_point begin = Clock::now();
    try {
        while (drawn_ < planned()) {
            const Clock::time_point imageBegin = Clock::now();
            drawImage();
            if (millisecondsSince(begin) + millisecondsSince(imageBegin) > milliseconds) break;
        }
    } catch (const Error& error) {  // graphics memory is full
        discard();
        obstacle_ = error.what();
    }
    if (drawn_ < planned()) return true;
    renderer_.reset();
    return false;
}

void KeptImages::drawImage() {
    if (!stack_.allocated()) stack_.allocate(info_.size.fullWidth(), info_.size.fullHeight(), planned());
    if (!renderer_) renderer_ = makeAccumulationRenderer(*world_, options_);
    drawAllSamples(*renderer_, samplesOf(plan_, drawn_, 1));
    stack_.store(drawn_, *renderer_->imageTexture());
    waitForGpu();
    ++drawn_;
}

std::vector<ShiftedImage> KeptImages::imagesFor(const Lens& lens) const {
    if (planned() == 0) return {};
    try {
        std::vector<ShiftedImage> images = shiftedImages(info_, {lens.focusDistance, lens.fStop}, "lens images");
        if (images.size() * 4 < planned()) images.clear();
        return images;
    } catch (const Error&) {  // focus distance or aperture out of range
        return {};
    }
}

void KeptImages::refocus(const Lens& lens) {
    assert(complete());
    std::vector<ImageStack::Part> parts;
    for (const ShiftedImage& image : imagesFor(lens))
        parts.push_back({static_cast<std::uint32_t>(image.image), info_.size.margin - image.move});
    stack_.computeMean(parts, info_.size.width, info_.size.height);
}

}  // namespace defocus::engine
