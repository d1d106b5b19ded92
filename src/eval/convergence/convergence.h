#pragma once
// Measures error against run time for each method, each of its settings and each number of lens samples. The reference
// is a converged image.
//
// Held equal: scene, camera, lens, image size, reference, process. The methods take turns frame by frame, so a slowdown
// of the machine affects all of them. A bench that stops early has measured all cases, with fewer runs each. Before a
// frame is timed, its first wave is drawn once, so that shaders, uploads and the driver's caches are ready. No thread
// is pinned to a core.
//
// Each finished frame is a ConvergenceRun and is reported at once. convergence/rows.h computes the medians.

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

// Settings with which a method is measured if it is named without settings of its own.
enum class MethodForm {
    published,  // as in its paper, if there is one
    best,       // Method::best; reported as `standard` if both are equal
    standard,
};
const char* methodFormName(MethodForm form);

// A method with the settings of its paper (frame/presets.h).
struct PublishedForm {
    std::string preset;
    MethodUse use;
    RenderSettings plan = {};        // except the number of samples
    const World* world = nullptr;    // the measured world with pyramids of these settings; null: the measured world
    double pyramidMilliseconds = 0;  // time that building the world's pyramids took
};

struct ConvergenceOptions {
    std::vector<MethodUse> methods;  // empty: all methods of the table, with standard settings
    std::vector<MethodForm> forms = {MethodForm::published, MethodForm::best,
                                     MethodForm::standard};  // for methods with standard settings
    std::vector<PublishedForm> published;                    // for MethodForm::published
    RenderSettings plan;                                     // base of every case; the lists below override it
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32, 64, 128, 256};  // for methods that use lens samples
    // For methods that draw levels of detail. Accumulation at full detail is always measured, in this list or not.
    std::vector<LodMode> lods = {LodMode::off, LodMode::fractional};
    std::vector<LodMetric> metrics = {LodMetric::measured};
    std::vector<double> thresholdFactors = {0.5, 1, 2};  // factors on defaultThresholds for the number of samples
    int runs = 3;                                        // runs of each case, ≥ 1
    int seeds = 1;             // ≥ 1; run r draws with the plan's seed + r % seeds, which gives the errors a spread
    RendererOptions renderer;  // its `settings` are not used
};

// A case to measure: a method with one setting and one number of lens samples.
struct ConvergenceCase {
    MethodUse use;
    std::string form;  // "published", "best", "standard"; empty for other settings
    // "lod=fractional metric=size thresholds=2", "components=5"; "standard" for the defaults; a preset's name.
    std::string setting;
    std::uint32_t samples = 0;  // requested lens samples; 0 if the method takes none
    RenderSettings plan;
    const World* world = nullptr;    // null: the measured world
    double pyramidMilliseconds = 0;  // time that building the pyramids of `world` took
    [[nodiscard]] bool usesLevels() const { return plan.lod != LodMode::off; }
};

// Returns the cases, ordered by their number of samples; for each number, accumulation at full detail comes first.
// Methods without lens samples come with the first number. Accumulation at full detail is always included, and so are
// the ray tracers "embree" and "embree-shared" if the table has them. Post-process methods and ray tracers have full
// detail only. Published forms have their own level settings and ignore the lists.
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
    std::uint32_t asked = 0;         // requested lens samples; 0 if the method takes none
    int run = 0;                     // counted from 0
    std::uint32_t samples = 0;       // lens samples drawn
    double pyramidMilliseconds = 0;  // set-up time: simplifying all meshes, if the case uses levels
    double setupMilliseconds = 0;    // set-up time of the renderer (uploads, shaders, hierarchies of the ray tracer)
    double milliseconds = 0;         // wall-clock time of the frame
    double gpuMilliseconds = 0;      // from timer queries, which miss the vertex work on a software driver
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;  // peak size of the renderer's resources
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
    // Gets each skipped case and the reason. Either the method can't render the scene (a ray tracer without environment
    // maps …), or its image differs from the reference by design (Method::shadesAsLit, drawsMotion). The other cases
    // are still measured.
    std::function<void(const ConvergenceCase& wanted, const std::string& reason)> leftOut;
};

// Measures the runs that are missing from `done`, the runs of an earlier call. `pyramidMilliseconds` is the time that
// building the world's pyramids took. Needs a current GL context. Throws Error if accumulation at full detail can't be
// drawn.
void measureConvergence(const World& world, const View& view, const ReferenceImage& reference,
                        const ConvergenceOptions& options, double pyramidMilliseconds,
                        std::span<const ConvergenceRun> done, const ConvergenceVisitor& visitor,
                        const Progress& progress = {});

}  // namespace defocus::engine
