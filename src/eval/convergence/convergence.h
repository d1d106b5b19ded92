#pragma once
// Measures image error against render time for each method, setting and number of lens samples. The error is the
// difference from a converged reference image.
//
// All cases have the same scene, camera, lens, image size and reference, and are measured in one process. Runs
// alternate between all cases, so a slowdown of the machine affects all of them. A bench that stops early has measured
// all cases, with fewer runs of each. Before a frame is timed, its first batch of lens samples (wave) is drawn once, so
// that shaders, uploads and driver caches are ready. Threads are not pinned to cores.
//
// Each finished frame is reported at once as a ConvergenceRun. convergence/rows.h computes medians of these runs.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/driver/reference_image.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus::engine {

// Variants of a method's settings that are measured if the user gives only the method's name.
enum class MethodForm {
    published,  // settings of the paper that describes the method; not measured if there is no paper
    best,       // settings that minimize the error (Method::best); named `default` if they are the defaults
    defaults,
};
const char* methodFormName(MethodForm form);

// A method that is measured with the settings published in its paper. The settings come from a preset
// (frame/settings/presets.h).
struct PublishedForm {
    std::string preset;
    MethodUse use;
    RenderSettings plan = {};        // all settings except the number of samples
    const World* world = nullptr;    // world with pyramids for the published settings; null: that of all other cases
    double pyramidMilliseconds = 0;  // build time of the pyramids of `world`
};

struct ConvergenceOptions {
    std::vector<MethodUse> methods;  // methods to measure; empty: all, with default settings
    std::vector<MethodForm> forms = {MethodForm::published, MethodForm::best,
                                     MethodForm::defaults};  // variants of methods that are given without settings
    std::vector<PublishedForm> published;                    // the methods' settings for MethodForm::published
    RenderSettings plan;                                     // settings of all cases; the lists below vary some of them
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32, 64, 128, 256};  // for methods that use lens samples
    // Level modes for methods that draw levels of detail. Accumulation at full detail is measured even if LodMode::off
    // is not listed.
    std::vector<LodMode> lods = {LodMode::off, LodMode::fractional};
    std::vector<LodMetric> metrics = {LodMetric::measured};
    std::vector<double> thresholdFactors = {0.5, 1, 2};  // factors that multiply the default level thresholds
    int runs = 3;                                        // number of runs of each case, ≥ 1
    int seeds = 1;  // number of seeds, ≥ 1, to show the spread between seeds; run r uses seed plan.seed + r % seeds
    RendererOptions renderer;  // options of all renderers; RendererOptions::settings is ignored
};

// A case to measure: a method with its settings and a number of lens samples.
struct ConvergenceCase {
    MethodUse use;
    std::string form;  // variant of the settings: "published", "best", "default"; empty for other settings
    // Text that describes the settings: "lod=fractional metric=size thresholds=2", "components=5", "default" for the
    // defaults, or a preset's name.
    std::string setting;
    std::uint32_t samples = 0;  // requested lens samples; 0 if the method uses none
    RenderSettings plan;
    const World* world = nullptr;    // world to draw; null: the world of all other cases
    double pyramidMilliseconds = 0;  // build time of the pyramids of `world`
    [[nodiscard]] bool usesLevels() const { return plan.lod != LodMode::off; }
};

// Returns the cases, ordered by number of samples. For each number, accumulation at full detail comes first. It is
// always included, as are the ray tracers "embree" and "embree-shared" if the program has them. Methods without lens
// samples are listed once, with the smallest number. Post-process methods and ray tracers are measured at full detail
// only. Cases with published settings ignore `lods`, `metrics` and `thresholdFactors`.
std::vector<ConvergenceCase> convergenceCases(const ConvergenceOptions& options);

// Error of an image relative to the reference, computed from display-encoded values; see image/metrics.h.
struct ImageError {
    double mse = 0;
    double ssim = 1;
    double flip = 0;
    [[nodiscard]] double psnr() const;  // returns the PSNR in dB; infinity for equal images
};

// Measurement of one run of a case.
struct ConvergenceRun {
    std::string method;
    std::string form;
    std::string setting;
    std::uint32_t asked = 0;         // requested lens samples; 0 if the method uses none
    int run = 0;                     // index of the run within its case, from 0
    std::uint32_t samples = 0;       // number of lens samples drawn
    double pyramidMilliseconds = 0;  // build time of the pyramids, if the case uses levels
    double setupMilliseconds = 0;    // set-up time of the renderer: uploads, shaders, ray-tracing structures
    double milliseconds = 0;         // wall-clock time of the frame
    double gpuMilliseconds = 0;      // GPU time from timer queries, which miss the vertex work on software drivers
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;  // peak size of the renderer's resources
    std::uint64_t imageHash = 0;
    ImageError error;                // difference of the image from the reference image
    std::optional<ImageError> bias;  // difference from full detail with the same lens samples; nullopt without levels
    std::string fault;               // why the image is invalid; empty if it is valid
};

// Returns whether `run` is a run of the case `wanted`.
bool sameCase(const ConvergenceRun& run, const ConvergenceCase& wanted);

struct ConvergenceVisitor {
    // Called with each frame as soon as it is measured. `image` and its FLIP map are non-null only in the first run of
    // a case.
    std::function<void(const ConvergenceRun& run, const Image* image, const Image* flipMap)> run;
    // Called with each skipped case and the reason. Either the method cannot render the scene (for example, a ray
    // tracer that doesn't support environment maps), or its image differs from the reference by design
    // (Method::shadesAsLit, drawsMotion).
    std::function<void(const ConvergenceCase& wanted, const std::string& reason)> leftOut;
};

// Measures all runs except the runs in `done`, which an earlier call has measured. `pyramidMilliseconds`: build time of
// the world's pyramids. Needs a current GL context. Throws Error if accumulation at full detail cannot be drawn.
void measureConvergence(const World& world, const View& view, const ReferenceImage& reference,
                        const ConvergenceOptions& options, double pyramidMilliseconds,
                        std::span<const ConvergenceRun> done, const ConvergenceVisitor& visitor,
                        const Progress& progress = {});

}  // namespace defocus::engine
