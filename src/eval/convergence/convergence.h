#pragma once
// Measures error against run time: for each method, each of its settings and each number of lens samples, against a
// converged reference.
//
// Held equal: scene, camera, lens, image size, reference, process. The methods take turns frame by frame. So a machine
// that slows down slows all of them, and a bench that is stopped early has measured all cases, with fewer runs each.
// Before a frame is timed, its first wave is drawn once, so that shaders, uploads and the driver's caches are ready. No
// thread is pinned to a core.
//
// Each finished frame is a ConvergenceRun and is handed out at once. convergence/rows.h makes medians of them.

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

// Which rows a method has that is named without settings of its own.
enum class MethodForm {
    published,  // as its paper has it, where there is one
    best,       // Method::best; where that is the standard, it is called so
    standard,
};
const char* methodFormName(MethodForm form);

// A method as its paper has it (frame/presets.h).
struct PublishedForm {
    std::string preset;
    MethodUse use;
    RenderSettings plan = {};        // except samples
    const World* world = nullptr;    // the measured one, with pyramids of these settings; null: just the measured one
    double pyramidMilliseconds = 0;  // time that building the world's pyramids took
};

struct ConvergenceOptions {
    std::vector<MethodUse> methods;  // empty: all methods of the table, with standard settings
    std::vector<MethodForm> forms = {MethodForm::published, MethodForm::best,
                                     MethodForm::standard};  // of methods with standard settings
    std::vector<PublishedForm> published;                    // for MethodForm::published
    RenderSettings plan;                                     // of every case, except for what the lists below choose
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32, 64, 128, 256};  // for methods that use lens samples
    // For methods that draw levels of detail. Accumulation at full detail is always measured, in this list or not.
    std::vector<LodMode> lods = {LodMode::off, LodMode::fractional};
    std::vector<LodMetric> metrics = {LodMetric::measured};
    std::vector<double> thresholdFactors = {0.5, 1, 2};  // on defaultThresholds for the number of samples
    int runs = 3;                                        // of each case, ≥ 1
    int seeds = 1;             // ≥ 1; run r draws with the plan's seed + r % seeds, so that errors have a spread, too
    RendererOptions renderer;  // its `settings` are not used
};

// A case to measure: a method with one setting and one number of lens samples.
struct ConvergenceCase {
    MethodUse use;
    std::string form;  // "published", "best", "standard"; empty for other settings
    // "lod=fractional metric=size thresholds=2", "components=5"; "standard" for the defaults; a preset's name.
    std::string setting;
    std::uint32_t samples = 0;  // lens samples asked for; 0 if the method takes none
    RenderSettings plan;
    const World* world = nullptr;    // null: the measured one
    double pyramidMilliseconds = 0;  // of `world`, if it has one
    [[nodiscard]] bool usesLevels() const { return plan.lod != LodMode::off; }
};

// Returns the cases in the order of their number of samples; within each number, accumulation at full detail comes
// first. A method that takes no lens samples has its cases among the first. Accumulation at full detail is always
// included, and so are the ray tracers "embree" and "embree-shared" if the table has them. Post-process methods and ray
// tracers have full detail only. What the lists say of levels isn't for published forms, which have their own.
std::vector<ConvergenceCase> convergenceCases(const ConvergenceOptions& options);

// The error of an image on display-encoded values; see metrics.h.
struct ImageError {
    double mse = 0;
    double ssim = 1;
    double flip = 0;
    [[nodiscard]] double psnr() const;  // dB; infinity for equal images
};

// One frame.
struct ConvergenceRun {
    std::string method;
    std::string form;
    std::string setting;
    std::uint32_t asked = 0;         // lens samples asked for; 0 if the method takes none
    int run = 0;                     // counted from 0
    std::uint32_t samples = 0;       // lens samples drawn
    double pyramidMilliseconds = 0;  // set-up time: simplifying all meshes, if the case uses levels
    double setupMilliseconds = 0;    // set-up time of the renderer (uploads, shaders, hierarchies of the ray tracer)
    double milliseconds = 0;         // wall clock, of the frame
    double gpuMilliseconds = 0;      // by timer queries, which miss the work on vertices on a software driver
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;  // the most that the renderer's resources took
    std::uint64_t imageHash = 0;
    ImageError error;                // against the reference
    std::optional<ImageError> bias;  // only with levels: against full detail at the same lens samples
    std::string fault;               // says why the image isn't valid; empty if it is
};

// Returns whether `run` belongs to the case `wanted`.
bool sameCase(const ConvergenceRun& run, const ConvergenceCase& wanted);

struct ConvergenceVisitor {
    // Gets each frame as soon as it is measured. `image` and its FLIP map come with the first frame of a case only.
    std::function<void(const ConvergenceRun& run, const Image* image, const Image* flipMap)> run;
    // Gets each case that is skipped, and the reason: the method can't render the scene (a ray tracer without
    // environment maps …), or it would show another image than the reference (Method::shadesAsLit, drawsMotion). The
    // other cases go on.
    std::function<void(const ConvergenceCase& wanted, const std::string& reason)> leftOut;
};

// Measures what is missing from `done`, the runs of an earlier call. `pyramidMilliseconds` is the time that building
// the world's pyramids took. Needs a current GL context. Throws Error if accumulation at full detail can't be drawn.
void measureConvergence(const World& world, const View& view, const ReferenceImage& reference,
                        const ConvergenceOptions& options, double pyramidMilliseconds,
                        std::span<const ConvergenceRun> done, const ConvergenceVisitor& visitor,
                        const Progress& progress = {});

}  // namespace defocus::engine
