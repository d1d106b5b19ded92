#pragma once
// The benchmark of Jeong, Kim and Lee 2011 (their Figure 2). Measures how much faster a frame is with levels of detail
// than at full detail, for a fixed camera. Varies the number of lens samples, the f-number and the focus distance.
//
// Held equal between the three modes: scene, camera, lens, lens samples, image size, layers drawn at once, process,
// renderer. Runs of all compared modes and methods alternate, so a slowdown of the machine affects all of them.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "eval/seed_errors.h"
#include "eval/spread.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus::engine {

// Settings for the choice of levels and lens samples, and a world whose pyramids use the same settings.
struct SpeedupForm {
    std::string preset;              // empty: none
    const World* world = nullptr;    // scene, pose, lights and environment are equal in all forms
    RenderSettings plan;             // except the number of samples and the mode
    double pyramidMilliseconds = 0;  // time that building the world's pyramids took
};

struct SpeedupOptions {
    std::vector<std::uint32_t> sampleCounts = {16, 32, 64, 128, 256, 512};  // with the view's own lens
    std::vector<double> fStops;                                             // further f-numbers, at `sweepSamples`
    std::vector<double> focusDistances;  // further focus distances, m, at `sweepSamples`
    std::uint32_t sweepSamples = 64;
    std::vector<MethodUse> methods;  // measured in addition to accumulation, with the last form's settings
    int runs = 5;                    // runs of each frame, ≥ 1
    int seeds = 5;  // ≥ 1; run r draws with the plan's seed + r % seeds, which gives the errors a spread
    // Lens samples of the converged reference for each lens (reference_image.h). Default: eight times the largest
    // number of samples measured with the lens, which takes about two thirds of the time of three runs of all modes. 0
    // disables the reference.
    std::optional<std::uint32_t> referenceSamples;
    RendererOptions renderer;
};

// Result with levels that are coarse for one cause alone (LodCause).
struct SpeedupPart {
    double milliseconds = 0;  // median wall-clock time of a frame
    double speedUp = 1;       // median time of full detail divided by `milliseconds`
    std::uint64_t triangles = 0;
    Difference fromFullDetail;
};

struct SpeedupRow {
    std::string sweep;   // "samples", "aperture" or "focus"
    std::string preset;  // preset of the form; empty: none
    std::string method;  // with its settings, separated by spaces
    std::uint32_t samples = 0;
    double fStop = 0;
    double focusDistance = 0;  // m
    LodMode mode = LodMode::off;
    int runs = 0;
    Spread milliseconds;             // wall-clock time of a frame
    Spread gpuMilliseconds;          // from timer queries, which miss the vertex work on a software driver
    double setupMilliseconds = 0;    // set-up of the renderer; not part of `milliseconds`
    double pyramidMilliseconds = 0;  // of building the pyramids, if levels are used; not part of `milliseconds`
    double speedUp = 1;              // median time of the form's full detail divided by this median
    std::optional<SpeedupPart> sizeOnly, blurOnly;  // set for accumulation with fractional levels
    std::uint64_t triangles = 0;
    std::uint64_t gpuBytes = 0;               // peak size of the renderer's resources
    Difference fromFullDetail;                // at the same lens samples, of the first seed
    std::optional<Difference> fromReference;  // the mean over the seeds
    std::vector<SeedError> ofSeeds;           // from the reference, of each seed that was drawn
    std::uint32_t referenceSamples = 0;       // 0 if there is no reference
    Difference referenceRemaining;            // the reference's estimate of its own error
};

// Calls `visit` with each row as soon as it is measured. Each setting has full detail, nearest level and fractional
// level of each form, then each further method. `forms` must not be empty. Needs a current GL context. Throws Error
// like planning and rendering.
void measureSpeedup(std::span<const SpeedupForm> forms, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
