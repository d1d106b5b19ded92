#pragma once
// Repeats the benchmark of Jeong, Kim and Lee 2011 (Figure 2): measures how much faster a frame is with levels of
// detail than at full detail, for a fixed camera. Varies the number of lens samples, the f-number and the focus
// distance.
//
// Three level modes are compared: full detail, nearest level and fractional levels. Constant between them: scene,
// camera, lens, lens samples, image size, number of layers per draw, process and renderer. Runs alternate between all
// compared modes and methods, so a slowdown of the machine affects all of them.

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

// A variant to compare: settings of levels and lens samples, and a world whose pyramids are built with these settings.
struct SpeedupForm {
    std::string preset;              // name of the preset (settings of a publication); empty: none
    const World* world = nullptr;    // scene to draw; the worlds of all SpeedupForms differ only in their pyramids
    RenderSettings plan;             // settings; the number of samples and the level mode are ignored
    double pyramidMilliseconds = 0;  // build time of the world's pyramids
};

struct SpeedupOptions {
    std::vector<std::uint32_t> sampleCounts = {16, 32, 64, 128, 256, 512};  // sample counts for the view's own lens
    std::vector<double> fStops;                                             // f-numbers to measure with `sweepSamples`
    std::vector<double> focusDistances;  // focus distances (m) to measure with `sweepSamples`
    std::uint32_t sweepSamples = 64;
    std::vector<MethodUse> methods;  // methods to measure in addition to accumulation, with the first SpeedupForm only
    int runs = 5;                    // number of runs of each frame, ≥ 1
    int seeds = 5;                   // number of seeds, ≥ 1; run r uses the plan's seed + r % seeds
    // Number of lens samples of the converged reference image for each lens (reference_image.h); 0: no reference.
    // Default: eight times the largest number of samples measured with that lens. With this default, rendering the
    // reference takes about as long as two runs of all level modes.
    std::optional<std::uint32_t> referenceSamples;
    RendererOptions renderer;
};

// Result for levels that are chosen for one cause only: projected size or blur (LodCause).
struct SpeedupPart {
    double milliseconds = 0;  // median wall-clock time of a frame
    double speedUp = 1;       // median time at full detail divided by `milliseconds`
    std::uint64_t triangles = 0;
    Difference fromFullDetail;
};

struct SpeedupRow {
    std::string sweep;   // varied parameter: "samples", "aperture" or "focus"
    std::string preset;  // name of the preset that the row's settings come from; see SpeedupForm
    std::string method;  // name of the method and its settings, separated by spaces
    std::uint32_t samples = 0;
    double fStop = 0;
    double focusDistance = 0;  // focus distance, m
    LodMode mode = LodMode::off;
    int runs = 0;
    Spread milliseconds;             // wall-clock time of a frame
    Spread gpuMilliseconds;          // GPU time from timer queries; with software drivers, excludes vertex work
    double setupMilliseconds = 0;    // set-up time of the renderer; not part of `milliseconds`
    double pyramidMilliseconds = 0;  // build time of the pyramids, if levels are used; not part of `milliseconds`
    double speedUp = 1;  // median time of the same settings at full detail, divided by this row's median time
    // Results for levels chosen for size only and for blur only; set only for accumulation with fractional levels.
    std::optional<SpeedupPart> sizeOnly, blurOnly;
    std::uint64_t triangles = 0;
    std::uint64_t gpuBytes = 0;  // peak size of the renderer's resources
    Difference fromFullDetail;   // difference between the images of this row and of full detail, first seed
    std::optional<Difference> fromReference;  // difference from the reference image, mean over the seeds
    std::vector<SeedError> ofSeeds;           // difference from the reference image, one per measured seed
    std::uint32_t referenceSamples = 0;       // lens samples of the reference; 0: no reference
    Difference referenceRemaining;            // estimated error of the reference image itself
};

// For each setting (a lens and a number of samples), measures accumulation with each SpeedupForm in `forms`: at full
// detail, with the nearest level and with fractional levels. Then measures the methods in `options.methods`. Calls
// `visit` with each row as soon as it is measured. `forms` must not be empty. Needs a current GL context. Throws Error
// in the same cases as planning and rendering.
void measureSpeedup(std::span<const SpeedupForm> forms, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
