#include "view/bench/refocus_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/stopwatch.h"
#include "image/metrics.h"
#include "plan/motion/camera_path.h"
#include "view/bench/bench_picture.h"

namespace defocus::engine {

namespace {

constexpr int dragFrames = 20;

// A change in the focus distance or the f-number, as if the user dragged a slider.
struct Drag {
    std::string name;
    double focusDistance = 1;  // focus distance in m at the end of the drag
    double fStop = 1;          // f-number at the end of the drag
};

std::vector<Drag> dragsOf(const Document& document, const ViewState& state) {
    const View view = currentView(document, state);
    const double focus = view.lens.focusDistance;
    const double fStop = view.lens.fStop;
    const FocusRange range = keptRange(view, planFrame(document.frame->world, view, renderSettings(state.options)));
    const auto focusDrag = [&](double end) {
        const double to = focusBetween(focus, end, 0.5);
        return Drag{fmt::format("focus {:.3g} to {:.3g} m", focus, to), to, fStop};
    };
    const double stopped = fStop * std::numbers::sqrt2;
    return {focusDrag(range.nearest),
            focusDrag(range.farthest),
            {fmt::format("f/{:.3g} to f/{:.3g}", fStop, stopped), focus, stopped}};
}

class DragRun {
public:
    DragRun(Document& document, ViewState& state, const ViewBenchOptions& options)
        : state_(state), picture_(document, state, options.software) {}

    // Simulates the drag, and sets the times and qualities in `row`. Returns the last image of the drag and the first
    // image at full quality.
    std::pair<Image, Image> run(const Drag& drag, RefocusBenchRow& row) {
        rest();
        row.keptImages = picture_.image().keptImages() ? picture_.image().keptImages()->drawn() : 0;
        const double focusBefore = state_.lens.focusDistance;
        const double fStopBefore = state_.lens.fStop;
        std::vector<double> times;
        Clock::time_point begin;
        for (int frame = 1; frame <= dragFrames; ++frame) {
            const double share = static_cast<double>(frame) / dragFrames;
            state_.lens.focusDistance = focusBetween(focusBefore, drag.focusDistance, share);
            state_.lens.fStop = std::lerp(fStopBefore, drag.fStop, share);
            begin = Clock::now();
            picture_.draw();
            times.push_back(millisecondsSince(begin));
        }
        std::ranges::nth_element(times, times.begin() + dragFrames / 2);
        row.dragMilliseconds = times[dragFrames / 2];
        Image dragged = picture_.image().image();
        row.dragQuality.samples = picture_.image().samples();
        row.dragQuality.resolution = static_cast<double>(dragged.width) / state_.pictureSize.x;
        row.fullMilliseconds = times.back();
        while (!fullQuality()) {
            picture_.grow();
            row.fullMilliseconds = millisecondsSince(begin);
        }
        row.fullSamples = picture_.image().samples();
        return {std::move(dragged), picture_.image().image()};
    }

private:
    // Draws frames until the view is at rest, the image has full quality, and the images of all lens samples are
    // stored.
    void rest() {
        picture_.draw();
        do picture_.grow();
        while (picture_.image().moving() || picture_.image().refocused() || !fullQuality() || keeping());
    }

    [[nodiscard]] bool keeping() {
        const KeptImages* const kept = picture_.image().keptImages();
        return kept != nullptr && kept->drawn() < kept->planned();
    }

    [[nodiscard]] bool fullQuality() {
        const ViewPicture& image = picture_.image();
        return image.refocused() || image.finished() || (!image.moving() && image.samples() >= KeptImages::maxImages);
    }

    ViewState& state_;
    BenchPicture picture_;
};

double psnrOf(const Image& reference, const Image& image) {
    return compareImages(reference, enlarged(image, reference.width, reference.height)).psnr;
}

}  // namespace

void measureRefocus(Document& document, ViewState& state, const ViewBenchOptions& options,
                    const std::function<void(const RefocusBenchRow&)>& take, const Progress& progress) {
    const ViewState begin = state;
    for (const Drag& drag : dragsOf(document, state)) {
        View end = currentView(document, begin);
        end.lens.focusDistance = drag.focusDistance;
        end.lens.fStop = drag.fStop;
        const Image reference = benchReference(document, begin, end, options, progress);
        for (const MethodUse& method : options.methods) {
            for (const std::uint64_t imageBytes : {std::uint64_t{0}, begin.imageBytes}) {
                state = begin;
                state.imageBytes = imageBytes;
                state.budget = windowBudget(options.software);
                state.options.method = method.method->name;
                state.options.methodSettings = method.settings;
                RefocusBenchRow row;
                row.method = method.text();
                row.change = drag.name;
                const auto [dragged, full] = DragRun(document, state, options).run(drag, row);
                row.dragPsnr = psnrOf(reference, dragged);
                row.fullPsnr = psnrOf(reference, full);
                take(row);
            }
        }
    }
}

}  // namespace defocus::engine
