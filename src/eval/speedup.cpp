#include "eval/speedup.h"

#include <algorithm>
#include <array>

namespace defocus {

namespace {

constexpr std::array modes = {LodMode::off, LodMode::nearest, LodMode::fractional};
constexpr std::uint32_t warmUpSamples = 2;
constexpr std::uint32_t referenceOffset = 1u << 20;  // into the sequence of lens samples: its own

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
    RenderSettings settings;
    settings.sampleCount = setting.samples;
    settings.sequence = options.sequence;
    settings.lod = mode;
    settings.metric = options.metric;
    settings.thresholds = defaultThresholds(options.metric, setting.samples);
    return planFrame(world, setting.view, settings);
}

void finish(Renderer& renderer, const FramePlan& plan) {
    renderer.start(plan);
    while (renderer.advance()) {
    }
}

Image reference(const World& world, const View& view, const SpeedupOptions& options) {
    RenderSettings settings;
    settings.sampleCount = options.referenceSamples;
    settings.sequence = Sequence::halton;  // its own too
    settings.firstSample = referenceOffset;
    settings.lod = LodMode::off;
    RendererOptions precise = options.renderer;
    precise.layerFormat = LayerFormat::rgba32f;
    const auto renderer = methodNamed("accumulation").make(world, precise);
    finish(*renderer, planFrame(world, view, settings));
    return renderer->image();
}

struct Mode {
    std::unique_ptr<Renderer> renderer;
    FramePlan plan;
    std::vector<double> milliseconds;
    std::vector<double> gpuMilliseconds;
    Image image;
};

void run(Mode& mode) {
    finish(*mode.renderer, mode.plan);
    const RenderStats stats = mode.renderer->stats();
    mode.milliseconds.push_back(stats.renderMilliseconds);
    mode.gpuMilliseconds.push_back(stats.gpuMilliseconds);
    mode.image = mode.renderer->image();
}

SpeedupRow rowOf(const Setting& setting, LodMode lod, const Mode& mode, const Mode& fullDetail, const Image* truth) {
    SpeedupRow row;
    row.sweep = setting.sweep;
    row.samples = setting.samples;
    row.fStop = setting.view.lens.fStop;
    row.focusDistance = setting.view.lens.focusDistance;
    row.mode = lod;
    row.milliseconds = spreadOf(mode.milliseconds);
    row.gpuMilliseconds = spreadOf(mode.gpuMilliseconds);
    row.speedUp = spreadOf(fullDetail.milliseconds).median / row.milliseconds.median;
    row.triangles = mode.plan.trianglesDrawn;
    row.gpuBytes = mode.renderer->stats().peakBytes;
    row.fromFullDetail = compareImages(fullDetail.image, mode.image);
    if (truth != nullptr) row.fromReference = compareImages(*truth, mode.image);
    return row;
}

}  // namespace

void measureSpeedup(const World& world, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress) {
    const std::vector<Setting> settings = settingsOf(view, options);
    const std::uint64_t total = settings.size() * static_cast<std::size_t>(options.runs) * modes.size();
    std::uint64_t done = 0;
    std::optional<Image> truth;
    if (options.referenceSamples > 0) truth = reference(world, view, options);

    for (const Setting& setting : settings) {
        // Shaders, uploads and the driver's own caches are ready before anything is timed.
        std::array<Mode, modes.size()> measured;
        for (std::size_t m = 0; m < modes.size(); ++m) {
            measured[m].renderer = methodNamed("accumulation").make(world, options.renderer);
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
        const bool ownLens =
            setting.view.lens.fStop == view.lens.fStop && setting.view.lens.focusDistance == view.lens.focusDistance;
        for (std::size_t m = 0; m < modes.size(); ++m)
            visit(rowOf(setting, modes[m], measured[m], measured[0], truth && ownLens ? &*truth : nullptr));
    }
}

}  // namespace defocus
