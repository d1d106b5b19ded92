#include "capture/refocus_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>

#include "core/error.h"
#include "core/parallel.h"
#include "lens/aperture.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

constexpr double tolerance = 1e-9;  // relative tolerance of f-numbers and focus distances

bool isShapeField(const LensField& field) {
    return field.feature == LensFeature::shape || field.name == std::string_view("anamorphicRatio");
}

// Returns the lens with its aperture shape set to the default, a disk. An aperture image stays unchanged.
Lens withDisk(Lens lens) {
    const Lens defaults;
    for (const LensField& field : lensFields())
        if (isShapeField(field)) setLensField(lens, field, lensFieldValue(defaults, field));
    return lens;
}

bool sameShape(const Lens& a, const Lens& b) {
    return a.apertureImage == b.apertureImage && std::ranges::all_of(lensFields(), [&](const LensField& field) {
               return !isShapeField(field) || lensFieldValue(a, field) == lensFieldValue(b, field);
           });
}

// Lens of a frame, and a key that identifies all other inputs of the frame. Frames with equal keys differ only in focus
// distance, f-number and aperture shape.
struct StillFrame {
    std::string key;
    Lens lens;
};

StillFrame stillFrame(const Shot& shot, const SequenceBase& base, const FilmSettings& settings, int frame) {
    FrameMoment moment = frameAt(shot, base, frame);
    StillFrame still{{}, moment.view.lens};
    moment.frame = 0;
    moment.time = 0;
    moment.view.lens = withDisk(moment.view.lens);
    moment.view.lens.focusDistance = moment.view.lens.fStop = 1;
    still.key = settingsHash(settings, moment);
    return still;
}

// Returns the run that computes all frames with indices [first, end) in `stills` from one set of lens images; nullopt
// if one set is not enough. `number`: frame number of the run's first frame.
std::optional<RefocusRun> runOver(const std::vector<StillFrame>& stills, std::size_t first, std::size_t end, int number,
                                  std::uint32_t samples) {
    const Lens& lens = stills[first].lens;
    RefocusRun run{
        {number, number + static_cast<int>(end - first) - 1}, lens, {lens.focusDistance, lens.focusDistance}};
    double narrowest = lens.fStop;
    bool oneShape = true;
    for (std::size_t i = first; i < end; ++i) {
        const Lens& other = stills[i].lens;
        run.lens.fStop = std::min(run.lens.fStop, other.fStop);
        narrowest = std::max(narrowest, other.fStop);
        run.range.nearest = std::min(run.range.nearest, other.focusDistance);
        run.range.farthest = std::max(run.range.farthest, other.focusDistance);
        oneShape = oneShape && sameShape(lens, other);
    }
    const double ratio = narrowest / run.lens.fStop;
    if (!oneShape || ratio > 1 + tolerance) run.lens = withDisk(run.lens);
    if (run.lens.apertureImage && (!oneShape || ratio > 1 + tolerance)) return {};
    run.lens.focusDistance = 2 / (1 / run.range.nearest + 1 / run.range.farthest);
    const double needed = std::ceil(samples * ratio * ratio - tolerance);
    if (!(needed <= static_cast<double>(maxImageParts))) return {};
    run.samples = static_cast<std::uint32_t>(needed);
    return run;
}

// Returns, of all runs that begin with frame `first`, the one that saves the most lens samples; nullopt if none saves
// any.
std::optional<RefocusRun> bestRun(const std::vector<StillFrame>& stills, std::size_t first, int number,
                                  std::uint32_t samples) {
    std::optional<RefocusRun> best;
    std::size_t saved = 0;
    for (std::size_t end = first + 1; end < stills.size() && stills[end].key == stills[first].key; ++end) {
        const std::optional<RefocusRun> run = runOver(stills, first, end + 1, number, samples);
        if (!run) break;
        const std::size_t rendered = samples * (end + 1 - first);
        if (rendered <= run->samples || rendered - run->samples <= saved) continue;
        saved = rendered - run->samples;
        best = run;
    }
    return best;
}

View viewOf(const RefocusRun& run, View view) {
    view.lens = run.lens;
    return view;
}

}  // namespace

std::string RefocusRun::text() const {
    const std::string text = fmt::format("lens images {} {} {} {} {}", lens.focusDistance, lens.fStop, range.nearest,
                                         range.farthest, samples);
    return sameShape(lens, withDisk(lens)) ? text + " of a disk" : text;
}

RefocusRuns refocusRuns(const Shot& shot, const SequenceBase& base, const FilmSettings& settings,
                        const FrameRange& frames, std::uint32_t samples) {
    std::vector<StillFrame> stills(static_cast<std::size_t>(frames.last - frames.first + 1));
    std::vector<std::exception_ptr> faults(stills.size());
    parallelFor(stills.size(), [&](std::size_t i) {
        try {
            stills[i] = stillFrame(shot, base, settings, frames.first + static_cast<int>(i));
        } catch (const Error&) {
            faults[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& fault : faults)
        if (fault) std::rethrow_exception(fault);

    RefocusRuns found;
    for (std::size_t first = 0; first < stills.size();) {
        const std::optional<RefocusRun> run = bestRun(stills, first, frames.first + static_cast<int>(first), samples);
        if (!run) {
            ++first;
            continue;
        }
        first = static_cast<std::size_t>(run->frames.last - frames.first + 1);
        try {
            static_cast<void>(lightFieldInfo(viewOf(*run, base.view), run->range));
            found.runs.push_back(*run);
        } catch (const Error& error) {
            found.rendered.push_back(fmt::format("frames {} to {} are rendered one by one: {}", run->frames.first,
                                                 run->frames.last, error.what()));
        }
    }
    return found;
}

const RefocusRun* runOf(const std::vector<RefocusRun>& runs, int frame) {
    const auto found = std::ranges::find_if(
        runs, [&](const RefocusRun& run) { return run.frames.first <= frame && frame <= run.frames.last; });
    return found != runs.end() ? &*found : nullptr;
}

std::uint64_t memoryOf(const RefocusRun& run, const View& view) {
    return KeptLensImages::bytes(lightFieldInfo(viewOf(run, view), run.range).size, run.samples);
}

RefocusedPictures::Picture RefocusedPictures::picture(const RefocusRun& run, Request request, const FrameMoment& moment,
                                                      SceneDriver& driver, const std::function<void(double)>& step) {
    const bool rendered = run_ != &run;
    if (rendered) {
        run_ = nullptr;
        images_.reset();  // frees the memory before the next images are drawn
        FrameMoment drawn = moment;
        drawn.view = viewOf(run, moment.view);
        request.samples = drawn.settings.sampleCount = run.samples;
        images_.emplace(driver, request, std::move(drawn), run.range, step);
        plan_ = driver.driver().plan();
        run_ = &run;
    }
    const Lens& lens = moment.view.lens;
    Refocusing refocusing{lens.focusDistance, lens.fStop, {}};
    if (!sameShape(lens, run.lens)) refocusing.shape = lens;
    Picture picture;
    picture.image = sharpSum(*images_, refocusing);
    picture.samples = static_cast<std::uint32_t>(shiftedImages(images_->info(), refocusing, images_->name()).size());
    picture.plan = plan_;
    picture.plan.view = moment.view;
    picture.rendered = rendered;
    return picture;
}

}  // namespace defocus::engine
