#include "eval/speedup/speedup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>

#include "core/stopwatch.h"
#include "frame/driver/reference_image.h"

namespace defocus::engine {

namespace {

constexpr std::array modes = {LodMode::off, LodMode::nearest, LodMode::fractional};
constexpr std::uint32_t warmUpSamples = 2;
// Default number of reference samples divided by the largest measured number of samples.
constexpr std::uint32_t referenceFactor = 8;

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

bool sameLens(const Setting& a, const Setting& b) {
    return a.view.lens.fStop == b.view.lens.fStop && a.view.lens.focusDistance == b.view.lens.focusDistance;
}

std::uint32_t referenceSamplesOf(const Setting& setting, const std::vector<Setting>& all,
                                 const SpeedupOptions& options) {
    if (options.referenceSamples) return *options.referenceSamples;
    std::uint32_t max = 0;
    for (const Setting& other : all)
        if (sameLens(other, setting)) max = std::max(max, other.samples);
    return std::clamp(referenceFactor * max, 2u, maxSamples);
}

// Renders the reference image with the lens of a setting (a lens and a number of samples). Consecutive settings with
// the same lens share the image.
class References {
public:
    References(const World& world, const std::vector<Setting>& settings, const SpeedupOptions& options,
               const Progress& progress)
        : world_(world), settings_(settings), options_(options), progress_(progress) {}

    // Returns the reference for the setting; null if no reference is requested.
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

// One of the compared variants of the frame (preset, method, level mode), with its renderer and its measurements.
struct SpeedupSubject {
    const SpeedupForm* form = nullptr;
    MethodUse use;
    LodMode mode = LodMode::off;
    LodCause cause = LodCause::blurAndSize;
    const SpeedupSubject* fullDetail = nullptr;  // the same variant at full detail
    std::unique_ptr<Renderer> renderer;
    std::vector<FramePlan> plans;  // plans of the frame, one per seed
    std::vector<double> milliseconds;
    std::vector<double> gpuMilliseconds;
    double setupMilliseconds = 0;           // set-up time of the renderer
    Image image;                            // image of the first seed
    std::vector<Difference> fromReference;  // errors relative to the reference, one per seed
};

// Returns the compared variants in the order of the rows. Variants whose levels depend on size alone or on blur alone
// (LodCause) have no row of their own; they follow the variant whose row includes their results.
std::deque<SpeedupSubject> subjectsOf(std::span<const SpeedupForm> forms, const std::vector<MethodUse>& methods) {
    std::deque<SpeedupSubject> subjects;  // a deque, because pointers to its elements stay valid
    const auto add = [&](const SpeedupForm& form, const MethodUse& use, LodMode mode, LodCause cause) {
        SpeedupSubject& subject = subjects.emplace_back();
        subject.form = &form;
        subject.use = use;
        subject.mode = mode;
        subject.cause = cause;
    };
    const MethodUse accumulation = parseMethodUse("accumulation");
    for (const SpeedupForm& form : forms) {
        const std::size_t first = subjects.size();
        for (const LodMode mode : modes) add(form, accumulation, mode, LodCause::blurAndSize);
        // The metric `proportional` has no size threshold: size alone gives full detail, and blur alone changes
        // nothing.
        if (form.plan.metric != LodMetric::proportional)
            for (const LodCause one : {LodCause::size, LodCause::blur})
                add(form, accumulation, LodMode::fractional, one);
        for (std::size_t i = first; i < subjects.size(); ++i) subjects[i].fullDetail = &subjects[first];
    }
    for (const MethodUse& use : methods) {
        add(forms.front(), use, use.method->drawsLevels() ? LodMode::fractional : LodMode::off, LodCause::blurAndSize);
        subjects.back().fullDetail = &subjects.front();
    }
    return subjects;
}

FramePlan planOf(const SpeedupSubject& subject, const Setting& setting, std::uint32_t samples, int seed = 0) {
    RenderSettings settings = subject.form->plan;
    settings.seed += static_cast<std::uint32_t>(seed);
    settings.sampleCount = samples;
    settings.lod = subject.mode;
    settings.lodCause = subject.cause;
    return planFrame(*subject.form->world, setting.view, settings);
}

// Plans the frame for all seeds, sets up the renderer, and draws one untimed frame to fill the driver's caches.
void prepare(SpeedupSubject& subject, const Setting& setting, int seeds, RendererOptions options) {
    for (int seed = 0; seed < seeds; ++seed) subject.plans.push_back(planOf(subject, setting, setting.samples, seed));
    const Clock::time_point begin = Clock::now();
    options.settings = subject.use.settings;
    subject.renderer = subject.use.method->make(*subject.form->world, options);
    subject.renderer->start(subject.plans.front());
    subject.setupMilliseconds = millisecondsSince(begin);
    drawAllSamples(*subject.renderer, planOf(subject, setting, std::min(setting.samples, warmUpSamples)));
}

// Draws and times run `number`. The runs use the seeds in turn.
void run(SpeedupSubject& subject, std::size_t number, const ReferenceImage* reference) {
    drawAllSamples(*subject.renderer, subject.plans[number % subject.plans.size()]);
    const RenderStats stats = subject.renderer->stats();
    subject.milliseconds.push_back(stats.renderMilliseconds);
    subject.gpuMilliseconds.push_back(stats.gpuMilliseconds);
    if (number >= subject.plans.size()) return;  // an earlier run has already drawn the image of this seed
    Image image = subject.renderer->image();
    if (reference != nullptr) subject.fromReference.push_back(compareImages(reference->image, image));
    if (number == 0) subject.image = std::move(image);
}

Difference meanOf(const std::vector<Difference>& differences) {
    if (differences.size() == 1) return differences.front();
    Difference mean = differences.front();
    double mse = 0, ssim = 0, flip = 0;
    for (const Difference& each : differences) {
        mse += each.rmse * each.rmse;
        ssim += each.ssim;
        flip += each.flip;
    }
    const auto count = static_cast<double>(differences.size());
    mean.rmse = std::sqrt(mse / count);
    mean.psnr = -20 * std::log10(mean.rmse);  // infinity if the RMSE is 0
    mean.ssim = ssim / count;
    mean.flip = flip / count;
    return mean;
}

double speedUpOf(const SpeedupSubject& subject) {
    return spreadOf(subject.fullDetail->milliseconds).median / spreadOf(subject.milliseconds).median;
}

SpeedupPart partOf(const SpeedupSubject& subject) {
    return {spreadOf(subject.milliseconds).median, speedUpOf(subject), subject.plans.front().trianglesDrawn,
            compareImages(subject.fullDetail->image, subject.image)};
}

SpeedupRow rowOf(const Setting& setting, const SpeedupSubject& subject, const ReferenceImage* reference) {
    SpeedupRow row;
    row.sweep = setting.sweep;
    row.preset = subject.form->preset;
    row.method = subject.use.text();
    std::ranges::replace(row.method, ',', ' ');
    row.samples = setting.samples;
    row.fStop = setting.view.lens.fStop;
    row.focusDistance = setting.view.lens.focusDistance;
    row.mode = subject.mode;
    row.runs = static_cast<int>(subject.milliseconds.size());
    row.milliseconds = spreadOf(subject.milliseconds);
    row.gpuMilliseconds = spreadOf(subject.gpuMilliseconds);
    row.speedUp = speedUpOf(subject);
    row.triangles = subject.plans.front().trianglesDrawn;
    row.setupMilliseconds = subject.setupMilliseconds;
    if (subject.mode != LodMode::off) row.pyramidMilliseconds = subject.form->pyramidMilliseconds;
    row.gpuBytes = subject.renderer->stats().peakBytes;
    row.fromFullDetail = compareImages(subject.fullDetail->image, subject.image);
    if (reference == nullptr) return row;
    row.fromReference = meanOf(subject.fromReference);
    for (const Difference& each : subject.fromReference) row.ofSeeds.push_back({each.rmse, each.flip});
    row.referenceSamples = reference->samples;
    row.referenceRemaining = reference->remaining;
    return row;
}

// Calls `visit` with the row of each variant. Variants whose levels depend on size alone or on blur alone have no row
// of their own; their results are in the row of the preceding variant.
void visitRows(const std::deque<SpeedupSubject>& subjects, const Setting& setting, const ReferenceImage* reference,
               const std::function<void(const SpeedupRow&)>& visit) {
    for (std::size_t i = 0; i < subjects.size();) {
        SpeedupRow row = rowOf(setting, subjects[i], reference);
        for (++i; i < subjects.size() && subjects[i].cause != LodCause::blurAndSize; ++i)
            (subjects[i].cause == LodCause::size ? row.sizeOnly : row.blurOnly) = partOf(subjects[i]);
        visit(row);
    }
}

}  // namespace

void measureSpeedup(std::span<const SpeedupForm> forms, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress) {
    const std::vector<Setting> settings = settingsOf(view, options);
    References references(*forms[0].world, settings, options, progress);
    const std::uint64_t total =
        settings.size() * static_cast<std::size_t>(options.runs) * subjectsOf(forms, options.methods).size();
    std::uint64_t done = 0;
    for (const Setting& setting : settings) {
        const ReferenceImage* const reference = references.of(setting);
        std::deque<SpeedupSubject> subjects = subjectsOf(forms, options.methods);
        for (SpeedupSubject& subject : subjects)
            prepare(subject, setting, std::min(options.seeds, options.runs), options.renderer);
        for (int i = 0; i < options.runs; ++i)
            for (SpeedupSubject& subject : subjects) {
                report(progress, "runs", done++, total);
                run(subject, static_cast<std::size_t>(i), reference);
            }
        visitRows(subjects, setting, reference, visit);
    }
}

}  // namespace defocus::engine
