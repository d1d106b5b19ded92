#include "eval/speedup/speedup.h"

#include <algorithm>
#include <array>

#include "core/stopwatch.h"
#include "frame/reference_image.h"

namespace defocus {

namespace {

constexpr std::array modes = {LodMode::off, LodMode::nearest, LodMode::fractional};
constexpr std::uint32_t warmUpSamples = 2;
constexpr std::uint32_t referenceFactor = 8;  // samples of the reference, unless told, over the most measured with it

struct Setting {
    const char* sweep;
    std::uint32_t samples;
    View view;
};

std::vector<Setting> settingsOf(const View& view, const SpeedupOptions& options) {
    std::vector<Setting> settings;
    for (const std::uint32_t samples : options.sampleCounts) settings.push_back({"samples", samples, view});
    for (const double fStop : options.fStops) {
        settings.push_back({"aperture", options.sweepSamples, view});
        settings.back().view.lens.fStop = fStop;
    }
    for (const double distance : options.focusDistances) {
        settings.push_back({"focus", options.sweepSamples, view});
        settings.back().view.lens.focusDistance = distance;
    }
    return settings;
}

FramePlan planOf(const World& world, const Setting& setting, LodMode mode, const SpeedupOptions& options) {
    RenderSettings settings = options.plan;
    settings.sampleCount = setting.samples;
    settings.lod = mode;
    return planFrame(world, setting.view, settings);
}

void finish(Renderer& renderer, const FramePlan& plan) {
    renderer.start(plan);
    while (renderer.advance()) {
    }
}

bool sameLens(const Setting& a, const Setting& b) {
    return a.view.lens.fStop == b.view.lens.fStop && a.view.lens.focusDistance == b.view.lens.focusDistance;
}

std::uint32_t referenceSamplesOf(const Setting& setting, const std::vector<Setting>& all,
                                 const SpeedupOptions& options) {
    if (options.referenceSamples) return *options.referenceSamples;
    std::uint32_t most = 0;
    for (const Setting& other : all)
        if (sameLens(other, setting)) most = std::max(most, other.samples);
    return std::clamp(referenceFactor * most, 2u, 65'536u);
}

// Of the setting's lens; that of the setting before where it has the same.
class References {
public:
    References(const World& world, const std::vector<Setting>& settings, const SpeedupOptions& options,
               const Progress& progress)
        : world_(world), settings_(settings), options_(options), progress_(progress) {}

    // Null where none is asked for.
    const ReferenceImage* of(const Setting& setting) {
        const std::uint32_t samples = referenceSamplesOf(setting, settings_, options_);
        if (samples == 0) return nullptr;
        if (last_ == nullptr || !sameLens(*last_, setting))
            image_ = renderedReference(world_, setting.view, {samples, options_.renderer}, progress_);
        last_ = &setting;
        return &image_;
    }

private:
    const World& world_;
    const std::vector<Setting>& settings_;
    const SpeedupOptions& options_;
    const Progress& progress_;
    const Setting* last_ = nullptr;
    ReferenceImage image_;
};

struct Mode {
    std::unique_ptr<Renderer> renderer;
    FramePlan plan;
    std::vector<double> milliseconds;
    std::vector<double> gpuMilliseconds;
    double setupMilliseconds = 0;  // of the renderer, once
    Image image;
};

void run(Mode& mode) {
    finish(*mode.renderer, mode.plan);
    const RenderStats stats = mode.renderer->stats();
    mode.milliseconds.push_back(stats.renderMilliseconds);
    mode.gpuMilliseconds.push_back(stats.gpuMilliseconds);
    mode.image = mode.renderer->image();
}

SpeedupRow rowOf(const Setting& setting, LodMode lod, const Mode& mode, const Mode& fullDetail,
                 const ReferenceImage* reference) {
    SpeedupRow row;
    row.sweep = setting.sweep;
    row.samples = setting.samples;
    row.fStop = setting.view.lens.fStop;
    row.focusDistance = setting.view.lens.focusDistance;
    row.mode = lod;
    row.runs = static_cast<int>(mode.milliseconds.size());
    row.milliseconds = spreadOf(mode.milliseconds);
    row.gpuMilliseconds = spreadOf(mode.gpuMilliseconds);
    row.speedUp = spreadOf(fullDetail.milliseconds).median / row.milliseconds.median;
    row.triangles = mode.plan.trianglesDrawn;
    row.setupMilliseconds = mode.setupMilliseconds;
    row.gpuBytes = mode.renderer->stats().peakBytes;
    row.fromFullDetail = compareImages(fullDetail.image, mode.image);
    if (reference == nullptr) return row;
    row.fromReference = compareImages(reference->image, mode.image);
    row.referenceSamples = reference->samples;
    row.referenceRemaining = reference->remaining;
    return row;
}

}  // namespace

void measureSpeedup(const World& world, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress) {
    const std::vector<Setting> settings = settingsOf(view, options);
    const std::uint64_t total = settings.size() * static_cast<std::size_t>(options.runs) * modes.size();
    std::uint64_t done = 0;
    References references(world, settings, options, progress);

    for (const Setting& setting : settings) {
        const ReferenceImage* const reference = references.of(setting);
        // Shaders, uploads and the driver's own caches are ready before anything is timed.
        std::array<Mode, modes.size()> measured;
        for (std::size_t m = 0; m < modes.size(); ++m) {
            const Clock::time_point begin = Clock::now();
            measured[m].renderer = methodNamed("accumulation").make(world, options.renderer);
            measured[m].renderer->start(planOf(world, setting, modes[m], options));
            measured[m].setupMilliseconds = millisecondsSince(begin);
            measured[m].plan = planOf(world, setting, modes[m], options);
            Setting few = setting;
            few.samples = std::min(setting.samples, warmUpSamples);
            finish(*measured[m].renderer, planOf(world, few, modes[m], options));
        }
        for (int i = 0; i < options.runs; ++i)
            for (Mode& mode : measured) {
                report(progress, "runs", done++, total);
                run(mode);
            }
        for (std::size_t m = 0; m < modes.size(); ++m) {
            SpeedupRow row = rowOf(setting, modes[m], measured[m], measured[0], reference);
            if (modes[m] != LodMode::off) row.pyramidMilliseconds = options.pyramidMilliseconds;
            visit(row);
        }
    }
}

}  // namespace defocus
