#include "eval/convergence/convergence.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "core/enum_name.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/stopwatch.h"

namespace defocus::engine {

namespace {

constexpr const char* baselineMethod = "accumulation";
constexpr std::array alwaysThere = {"embree", "embree-shared"};

// ---- list of cases to measure ---------------------------------------------------------------------------------------

MethodUse defaultUse(const Method& method) {
    return {&method, completeSettings(method.name, method.settings, {})};
}

std::vector<MethodUse> chosenMethods(const ConvergenceOptions& options) {
    std::vector<MethodUse> uses = options.methods;
    const auto has = [&](const std::string& name) {
        return std::ranges::any_of(uses, [&](const MethodUse& use) { return use.method->name == name; });
    };
    // All methods except "auto", which itself only chooses one of the other methods.
    const bool all = uses.empty();
    for (const Method& method : methods())
        if ((all && method.name != automaticMethod) ||
            (std::ranges::count(alwaysThere, method.name) > 0 && !has(method.name)))
            uses.push_back(defaultUse(method));
    return uses;
}

std::string settingOf(const MethodUse& use, const std::string& levels) {
    std::string text = settingsText(use.method->settings, use.settings);
    std::ranges::replace(text, ',', ' ');
    if (!text.empty() && !levels.empty()) text += ' ';
    text += levels;
    return text.empty() ? "default" : text;
}

MethodUse bestUse(const Method& method) {
    return {&method, completeSettings(method.name, method.settings, method.best)};
}

std::string formOf(const MethodUse& use) {
    if (use.settings == defaultUse(*use.method).settings) return methodFormName(MethodForm::defaults);
    if (use.settings == bestUse(*use.method).settings) return methodFormName(MethodForm::best);
    return {};
}

ConvergenceCase fullDetailCase(const MethodUse& use, std::uint32_t samples, const RenderSettings& plan) {
    ConvergenceCase result{
        .use = use,
        .form = formOf(use),
        .setting = settingOf(use, use.method->drawsLevels() ? "lod=off" : ""),
        .samples = samples,
        .plan = plan,
    };
    result.plan.lod = LodMode::off;
    if (samples > 0) result.plan.sampleCount = samples;
    return result;
}

std::vector<ConvergenceCase> casesOf(const MethodUse& use, std::uint32_t samples, const ConvergenceOptions& options) {
    if (!use.method->drawsLevels()) return {fullDetailCase(use, samples, options.plan)};
    std::vector<ConvergenceCase> cases;
    for (const LodMode mode : options.lods) {
        if (mode == LodMode::off) {
            cases.push_back(fullDetailCase(use, samples, options.plan));
            continue;
        }
        for (const LodMetric metric : options.metrics)
            for (const double factor : options.thresholdFactors) {
                ConvergenceCase levels = fullDetailCase(use, samples, options.plan);
                levels.setting = settingOf(use, fmt::format("lod={} metric={} thresholds={:g}", lodModeName(mode),
                                                            lodMetricName(metric), factor));
                levels.plan.lod = mode;
                levels.plan.metric = metric;
                levels.plan.thresholds = {};
                fixThresholds(levels.plan, samples, factor);
                cases.push_back(std::move(levels));
            }
    }
    return cases;
}

std::vector<ConvergenceCase> publishedCases(const Method& method, std::uint32_t samples,
                                            const ConvergenceOptions& options) {
    std::vector<ConvergenceCase> cases;
    for (const PublishedForm& form : options.published) {
        if (form.use.method != &method) continue;
        cases.push_back({.use = form.use,
                         .form = methodFormName(MethodForm::published),
                         .setting = form.preset,
                         .samples = samples,
                         .plan = form.plan,
                         .world = form.world,
                         .pyramidMilliseconds = form.pyramidMilliseconds});
        if (samples > 0) cases.back().plan.sampleCount = samples;
        if (!method.drawsLevels()) cases.back().plan.lod = LodMode::off;
    }
    return cases;
}

// Returns the cases to measure for one method: one case if `use` changes any of the method's settings, otherwise one
// for each requested variant of its settings (published, best, default).
std::vector<ConvergenceCase> casesOfForms(const MethodUse& use, std::uint32_t samples,
                                          const ConvergenceOptions& options) {
    const Method& method = *use.method;
    if (use.settings != defaultUse(method).settings) return casesOf(use, samples, options);
    std::vector<ConvergenceCase> cases;
    for (const MethodForm form : options.forms) {
        std::vector<ConvergenceCase> more = form == MethodForm::published ? publishedCases(method, samples, options)
                                            : form == MethodForm::best    ? casesOf(bestUse(method), samples, options)
                                                                          : casesOf(use, samples, options);
        std::ranges::move(more, std::back_inserter(cases));
    }
    return cases;
}

// ---- measurement of one frame ---------------------------------------------------------------------------------------

struct Frame {
    ConvergenceRun run;
    Image image;
};

bool allFinite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); });
}

// Returns what is wrong with the image; empty if the image is valid.
std::string faultOf(const Image& image, const FramePlan& plan, const RenderStats& stats, const Method& method,
                    std::uint32_t sampleTotal) {
    if (image.width != plan.view.width || image.height != plan.view.height)
        return fmt::format("the image has {} x {} px instead of {} x {}", image.width, image.height, plan.view.width,
                           plan.view.height);
    if (!allFinite(image)) return "the image has NaN or infinite pixels";
    if (stats.samples != sampleTotal)
        return fmt::format("the image is incomplete: the method drew {} of {} samples", stats.samples, sampleTotal);
    const bool asPlanned = stats.samples == plan.samples.size() || stats.samples == plan.settings.sampleCount;
    if (method.usesLensSamples && !asPlanned)
        return fmt::format("the method drew {} lens samples instead of {}", stats.samples, plan.samples.size());
    if (method.name == baselineMethod && stats.trianglesDrawn != plan.trianglesDrawn)
        return fmt::format("the method drew {} triangles instead of {}", stats.trianglesDrawn, plan.trianglesDrawn);
    return {};
}

// Returns true unless the primitive is unlit and opaque.
bool needsShading(const Scene& scene, const Primitive& primitive) {
    const Material& material = materialAt(scene, primitive.material);
    return !material.unlit || material.alphaMode != AlphaMode::opaque;
}

bool needsShading(const Scene& scene) {
    return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        return std::ranges::any_of(mesh.primitives, [&](const Primitive& p) { return needsShading(scene, p); });
    });
}

// Throws Error if the method cannot match the reference on this scene, because its shading differs or because it draws
// no shadows or no motion.
void checkComparable(const Method& method, const World& world, const FramePlan& plan) {
    if (!method.shadesAsLit && needsShading(*world.scene))
        fail("the method's shading differs from the reference; use --shading unlit");
    if (!method.drawsShadows && !plan.shadows.maps.empty())
        fail("the method does not render shadows, but the reference has shadows");
    if (!method.drawsMotion && !plan.moments.empty())
        fail("the method does not render motion blur, but the scene moves while the shutter is open");
}

Frame frameOf(const World& world, const View& view, const ConvergenceCase& wanted, const RendererOptions& options) {
    const FramePlan plan = planFrame(world, view, wanted.plan);
    checkComparable(*wanted.use.method, world, plan);
    RendererOptions own = options;
    own.settings = wanted.use.settings;

    // Time the set-up of the renderer, then draw a first batch (wave) of lens samples, which isn't timed.
    const Clock::time_point begin = Clock::now();
    const std::unique_ptr<Renderer> renderer = wanted.use.method->make(world, own);
    renderer->start(plan);
    Frame frame;
    frame.run.setupMilliseconds = millisecondsSince(begin);
    renderer->advance();

    drawAllSamples(*renderer, plan);
    frame.image = renderer->image();
    const RenderStats stats = renderer->stats();
    frame.run.method = wanted.use.method->name;
    frame.run.form = wanted.form;
    frame.run.setting = wanted.setting;
    frame.run.asked = wanted.samples;
    frame.run.samples = stats.samples;
    frame.run.milliseconds = stats.renderMilliseconds;
    frame.run.gpuMilliseconds = stats.gpuMilliseconds;
    frame.run.triangles = stats.trianglesDrawn;
    frame.run.peakBytes = stats.peakBytes;
    frame.run.imageHash = hashBytes(std::as_bytes(std::span(frame.image.pixels)));
    frame.run.fault = faultOf(frame.image, plan, stats, *wanted.use.method, renderer->sampleTotal());
    return frame;
}

ImageError errorOf(const Difference& difference) {
    return {difference.rmse * difference.rmse, difference.ssim, difference.flip};
}

// ---- measurement of all cases ---------------------------------------------------------------------------------------

class Measurement {
public:
    Measurement(const World& world, const View& view, const ReferenceImage& reference, const RendererOptions& renderer,
                double pyramidMilliseconds, int seeds, std::span<const ConvergenceRun> done)
        : world_(world),
          view_(view),
          reference_(reference),
          renderer_(renderer),
          pyramidMilliseconds_(pyramidMilliseconds),
          seeds_(seeds),
          runs_(done.begin(), done.end()) {}

    [[nodiscard]] bool has(const ConvergenceCase& wanted, int run) const {
        return std::ranges::any_of(runs_, [&](const ConvergenceRun& r) { return r.run == run && sameCase(r, wanted); });
    }

    // Measures one run of a case; `number` is the index of the run. Throws Error if the method cannot draw the case.
    // Sets `flipMap` only in the first run of the case.
    Frame measure(ConvergenceCase wanted, int number, Image& flipMap) {
        wanted.plan.seed += static_cast<std::uint32_t>(number % seeds_);
        Frame frame = frameOf(wanted.world != nullptr ? *wanted.world : world_, view_, wanted, renderer_);
        ConvergenceRun& run = frame.run;
        run.run = number;
        if (wanted.usesLevels())
            run.pyramidMilliseconds = wanted.world != nullptr ? wanted.pyramidMilliseconds : pyramidMilliseconds_;
        if (wanted.use.method->name == baselineMethod && !wanted.usesLevels()) keepFullDetail(wanted, frame.image);
        measureError(frame, wanted, flipMap);
        runs_.push_back(run);
        return frame;
    }

private:
    // Identifies a set of lens samples by number of samples, sequence and seed.
    using SamplePoints = std::tuple<std::uint32_t, Sequence, std::uint32_t>;
    static SamplePoints pointsOf(const ConvergenceCase& wanted) {
        return {wanted.samples, wanted.plan.sequence, wanted.plan.seed};
    }

    // Sets the frame's error. Reuses the error of an earlier run if that run has the same seed and the same image.
    void measureError(Frame& frame, const ConvergenceCase& wanted, Image& flipMap) {
        ConvergenceRun& run = frame.run;
        const auto ofCase = [&](const ConvergenceRun& r) { return sameCase(r, wanted); };
        const auto known = std::ranges::find_if(
            runs_, [&](const ConvergenceRun& r) { return ofCase(r) && r.run % seeds_ == run.run % seeds_; });
        if (known != runs_.end() && known->imageHash == run.imageHash) {
            run.error = known->error;
            run.bias = known->bias;
            return;
        }
        if (frame.image.width != view_.width || frame.image.height != view_.height)
            return;  // the image has the wrong size, so report no error value
        CompareOptions options;
        if (std::ranges::none_of(runs_, ofCase)) options.flipMap = &flipMap;
        run.error = errorOf(compareImages(reference_.image, frame.image, options));
        if (wanted.usesLevels()) run.bias = errorOf(compareImages(fullDetailFor(wanted), frame.image));
    }

    void keepFullDetail(const ConvergenceCase& wanted, const Image& image) {
        fullDetailPoints_ = pointsOf(wanted);
        fullDetail_ = image;
    }

    // Returns the image at full detail with the same lens samples as `wanted`. The image is cached until other samples
    // are needed.
    const Image& fullDetailFor(const ConvergenceCase& wanted) {
        if (fullDetailPoints_ != pointsOf(wanted)) {
            const ConvergenceCase full =
                fullDetailCase(defaultUse(methodNamed(baselineMethod)), wanted.samples, wanted.plan);
            keepFullDetail(full, frameOf(world_, view_, full, renderer_).image);
        }
        return fullDetail_;
    }

    const World& world_;
    const View& view_;
    const ReferenceImage& reference_;
    const RendererOptions& renderer_;
    double pyramidMilliseconds_;
    int seeds_;
    std::vector<ConvergenceRun> runs_;
    SamplePoints fullDetailPoints_;
    Image fullDetail_;
};

}  // namespace

const char* methodFormName(MethodForm form) {
    return enumName<MethodForm::defaults>(form, {"published", "best", "default"});
}

double ImageError::psnr() const {
    return -10 * std::log10(mse);
}

bool sameCase(const ConvergenceRun& run, const ConvergenceCase& wanted) {
    return run.method == wanted.use.method->name && run.setting == wanted.setting && run.asked == wanted.samples;
}

std::vector<ConvergenceCase> convergenceCases(const ConvergenceOptions& options) {
    const std::vector<MethodUse> uses = chosenMethods(options);
    const std::set<std::uint32_t> counts(options.sampleCounts.begin(), options.sampleCounts.end());
    std::vector<ConvergenceCase> cases;
    std::set<std::tuple<std::string, std::string, std::uint32_t>> seen;
    const auto add = [&](ConvergenceCase wanted) {
        if (seen.emplace(wanted.use.method->name, wanted.setting, wanted.samples).second)
            cases.push_back(std::move(wanted));
    };
    for (const std::uint32_t count : counts) {
        add(fullDetailCase(defaultUse(methodNamed(baselineMethod)), count, options.plan));
        for (const MethodUse& use : uses)
            for (ConvergenceCase& wanted : casesOfForms(use, use.method->usesLensSamples ? count : 0, options))
                add(std::move(wanted));
    }
    return cases;
}

void measureConvergence(const World& world, const View& view, const ReferenceImage& reference,
                        const ConvergenceOptions& options, double pyramidMilliseconds,
                        std::span<const ConvergenceRun> done, const ConvergenceVisitor& visitor,
                        const Progress& progress) {
    const std::vector<ConvergenceCase> cases = convergenceCases(options);
    const std::uint64_t total = cases.size() * static_cast<std::size_t>(options.runs);
    std::uint64_t count = 0;
    Measurement measurement(world, view, reference, options.renderer, pyramidMilliseconds, options.seeds, done);
    std::set<std::string> leftOut;  // names of the skipped methods, with their settings

    for (int run = 0; run < options.runs; ++run)
        for (const ConvergenceCase& wanted : cases) {
            report(progress, "runs", count++, total);
            const std::string name = wanted.use.method->name + ' ' + wanted.setting;
            if (measurement.has(wanted, run) || leftOut.contains(name)) continue;
            Image flipMap;
            Frame frame;
            try {
                frame = measurement.measure(wanted, run, flipMap);
            } catch (const Error& error) {
                if (wanted.use.method->name == baselineMethod) throw;
                leftOut.insert(name);
                visitor.leftOut(wanted, error.what());
                continue;
            }
            const bool first = !flipMap.empty();
            visitor.run(frame.run, first ? &frame.image : nullptr, first ? &flipMap : nullptr);
        }
}

}  // namespace defocus::engine
