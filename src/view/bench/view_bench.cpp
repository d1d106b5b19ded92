#include "view/bench/view_bench.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <span>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "image/metrics.h"
#include "view/bench/bench_picture.h"

namespace defocus::engine {

namespace {

using namespace std::chrono_literals;

constexpr double step = glm::radians(1.0);    // angle of the orbit per frame
constexpr double settledSeconds = 1;          // time in s at rest before the orbit; users also pause before a movement
constexpr std::uint32_t minStillSamples = 4;  // the window shows an accumulated image from this number of samples on
constexpr double comparedShares[] = {0.25, 0.5, 0.75};  // fractions of the orbit at which PSNR is measured

struct ShownFrame {
    std::uint32_t frame = 0;  // index of the frame within the camera's orbit
    View view;
    Image image;  // frame as drawn, possibly smaller than the view
};

// Reference images by frame index; shared by all methods, whose camera path is the same.
using References = std::map<std::uint32_t, Image>;

double percentile95(std::vector<double> values) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, place);
    return *place;
}

class MethodRun {
public:
    MethodRun(Document& document, ViewState& state, const ViewBenchOptions& options, References& references)
        : document_(document),
          state_(state),
          options_(options),
          references_(references),
          picture_(document, state, options.software) {}

    ViewBenchRow measure(const MethodUse& method, const Progress& progress) {
        row_.method = method.text();
        state_.options.method = method.method->name;
        state_.options.methodSettings = method.settings;
        rest(settledSeconds);
        move(progress);
        rest(options_.restSeconds);
        row_.samples = picture_.image().samples();
        const ShownFrame still{options_.frames, currentView(document_, state_), picture_.image().image()};
        row_.movingPsnr = psnrOf(moving_, progress);
        row_.stillPsnr = psnrOf({&still, 1}, progress);
        return row_;
    }

private:
    // Draws until the image has converged or `seconds` have passed. Records the times of the first and the converged
    // image.
    void rest(double seconds) {
        const Clock::time_point begin = Clock::now();
        const auto elapsed = [&] { return 1e-3 * millisecondsSince(begin); };
        row_.stillPicture = row_.converged = std::numeric_limits<double>::infinity();
        while (elapsed() < seconds) {
            picture_.grow();
            const ViewPicture& image = picture_.image();
            if (image.moving()) continue;
            if (image.samples() >= minStillSamples) row_.stillPicture = std::min(row_.stillPicture, elapsed());
            if (!image.finished()) continue;
            row_.converged = elapsed();
            return;
        }
    }

    void move(const Progress& progress) {
        const ViewCamera start = state_.camera;
        std::vector<double> times;
        for (std::uint32_t frame = 1; frame <= options_.frames; ++frame) {
            report(progress, row_.method, frame - 1, options_.frames);
            state_.camera = orbited(start, frame * step, 0);
            state_.followsCamera = false;
            const Clock::time_point begin = Clock::now();
            picture_.draw();
            times.push_back(millisecondsSince(begin));
            for (const double share : comparedShares)
                if (frame == std::lround(share * options_.frames))
                    moving_.push_back({frame, currentView(document_, state_), picture_.image().image()});
        }
        row_.firstPicture = times.front();
        double sum = 0;
        for (const double time : times) sum += time;
        row_.framesPerSecond = 1000 * static_cast<double>(times.size()) / sum;
        row_.slowFrame = percentile95(times);
        row_.quality = state_.budget.quality();
    }

    const Image& referenceOf(const ShownFrame& frame, const Progress& progress) {
        Image& image = references_[frame.frame];
        if (!image.empty()) return image;
        image = benchReference(document_, state_, frame.view, options_, progress);
        return image;
    }

    double psnrOf(std::span<const ShownFrame> frames, const Progress& progress) {
        double squares = 0;
        for (const ShownFrame& frame : frames) {
            const Image shown = enlarged(frame.image, frame.view.width, frame.view.height);
            const Difference difference = compareImages(referenceOf(frame, progress), shown);
            squares += difference.rmse * difference.rmse;
        }
        return -10 * std::log10(squares / static_cast<double>(frames.size()));
    }

    Document& document_;
    ViewState& state_;
    const ViewBenchOptions& options_;
    References& references_;
    BenchPicture picture_;
    std::vector<ShownFrame> moving_;
    ViewBenchRow row_;
};

}  // namespace

void openForBench(Document& document, ViewState& state) {
    document.remembersFiles = false;
    document.loader.open(state.options);
    while (!document.frame || document.draft) {
        if (!takeLoadedScene(document, state)) std::this_thread::sleep_for(5ms);
        if (!document.frame && !state.fault.empty() && !document.loader.busy()) throw Error(state.fault);
    }
}

void measureView(Document& document, ViewState& state, const ViewBenchOptions& options,
                 const std::function<void(const ViewBenchRow&)>& take, const Progress& progress) {
    const ViewState begin = state;
    References references;
    for (const MethodUse& method : options.methods) {
        state = begin;
        state.options.targetError = options.convergedError;
        state.budget = windowBudget(options.software);
        take(MethodRun(document, state, options, references).measure(method, progress));
    }
}

}  // namespace defocus::engine
