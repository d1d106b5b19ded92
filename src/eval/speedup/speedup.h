#pragma once
// The benchmark of Jeong, Kim and Lee 2011 (their Figure 2). With a fixed camera, it measures how much faster a frame
// is with levels of detail than at full detail, over the number of lens samples, the f-number and the focus distance.
//
// Held equal between the three modes: scene, camera, lens, lens samples, image size, layers drawn at once, process,
// renderer. Runs of all that is compared alternate, so that a machine that slows down slows all of it.

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

// Settings by which levels are chosen and samples lie, and a world whose pyramids are of these settings.
struct SpeedupForm {
    std::string preset;              // empty: none
    const World* world = nullptr;    // each form's has the same scene, pose, lights and surroundings
    RenderSettings plan;             // except samples and mode
    double pyramidMilliseconds = 0;  // time that building the world's pyramids took
};

struct SpeedupOptions {
    std::vector<std::uint32_t> sampleCounts = {16, 32, 64, 128, 256, 512};  // with the view's own lens
    std::vector<double> fStops;                                             // further f-numbers, at `sweepSamples`
    std::vector<double> focusDistances;  // further focus distances, m, at `sweepSamples`
    std::uint32_t sweepSamples = 64;
    std::vector<MethodUse> methods;  // measured beside accumulation, each with the last form's settings
    int runs = 5;                    // of each frame, ≥ 1
    int seeds = 5;  // ≥ 1; run r draws with the plan's seed + r % seeds, so that errors have a spread
    // Lens samples of the converged reference for each lens (reference_image.h). If unset, it has eight times the
    // largest number of samples measured with the lens, which takes about two thirds of the time of three runs of all
    // modes. 0 makes no reference.
    std::optional<std::uint32_t> referenceSamples;
    RendererOptions renderer;
};

// Levels that are coarse for one reason alone (LodCause).
struct SpeedupPart {
    double milliseconds = 0;  // median, wall clock, of a frame
    double speedUp = 1;       // the median of full detail divided by this one
    std::uint64_t triangles = 0;
    Difference fromFullDetail;
};

struct SpeedupRow {
    std::string sweep;   // "samples", "aperture" or "focus"
    std::string preset;  // of the form; empty: none
    std::string method;  // with its settings, spaces between them
    std::uint32_t samples = 0;
    double fStop = 0;
    double focusDistance = 0;  // m
    LodMode mode = LodMode::off;
    int runs = 0;
    Spread milliseconds;             // wall clock, of a frame
    Spread gpuMilliseconds;          // by timer queries, which miss the work on vertices on a software driver
    double setupMilliseconds = 0;    // of the renderer; not part of `milliseconds`
    double pyramidMilliseconds = 0;  // of building the pyramids, if levels are used; not part of `milliseconds`
    double speedUp = 1;              // the median of the form's full detail divided by this one
    std::optional<SpeedupPart> sizeOnly, blurOnly;  // of accumulation from fractional levels
    std::uint64_t triangles = 0;
    std::uint64_t gpuBytes = 0;               // the most that the renderer's resources took
    Difference fromFullDetail;                // at the same lens samples, of the first seed
    std::optional<Difference> fromReference;  // the mean over the seeds
    std::vector<SeedError> ofSeeds;           // from the reference, of each seed that was drawn
    std::uint32_t referenceSamples = 0;       // 0 if there is no reference
    Difference referenceRemaining;            // the reference's estimate of its own error
};

// Calls `visit` with each row as soon as it is measured: for each setting, full detail, nearest level and fractional
// level of each form, of which there is one or more, and then each further method. Needs a current GL context. Throws
// Error like planning and rendering.
void measureSpeedup(std::span<const SpeedupForm> forms, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
