#pragma once
// The benchmark of Jeong, Kim and Lee 2011 (their Figure 2): a fixed camera, and how much faster a frame is with levels
// of detail than at full detail, over the number of lens samples, the f-number and the focus distance.
//
// Held equal within a row's group: scene, camera, lens, lens samples, image size, layers drawn at once, process,
// renderer. Runs of the three modes alternate, so that a machine that slows down slows all of them.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "eval/spread.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus {

struct SpeedupOptions {
    std::vector<std::uint32_t> sampleCounts = {16, 32, 64, 128, 256, 512};  // with the view's own lens
    std::vector<double> fStops;                                             // further f-numbers, at `sweepSamples`
    std::vector<double> focusDistances;  // further focus distances, m, at `sweepSamples`
    std::uint32_t sweepSamples = 64;
    int runs = 3;  // of each mode; 1 or more
    // Of a converged reference (reference_image.h) for each lens. None: eight times the most that are measured with the
    // lens, which takes about two thirds of the time of three runs of all modes. 0: no reference.
    std::optional<std::uint32_t> referenceSamples;
    double pyramidMilliseconds = 0;  // what the world's pyramids took
    RenderSettings plan;             // of all that is measured, but samples and mode
    RendererOptions renderer;
};

struct SpeedupRow {
    std::string sweep;  // "samples", "aperture" or "focus"
    std::uint32_t samples = 0;
    double fStop = 0;
    double focusDistance = 0;  // m
    LodMode mode = LodMode::off;
    int runs = 0;
    Spread milliseconds;             // a frame, wall clock
    Spread gpuMilliseconds;          // timer queries; on a software driver these miss vertex work
    double setupMilliseconds = 0;    // of the renderer, not in `milliseconds`
    double pyramidMilliseconds = 0;  // of the pyramids, where levels are used; not in `milliseconds`
    double speedUp = 1;              // full detail's median over this one's
    std::uint64_t triangles = 0;
    std::uint64_t gpuBytes = 0;  // resources held by the renderer, at their peak
    Difference fromFullDetail;   // at the same number of samples
    std::optional<Difference> fromReference;
    std::uint32_t referenceSamples = 0;  // 0: there is none
    Difference referenceRemaining;       // the reference's estimate of its own error
};

// Calls `visit` with each row as soon as it is measured: full detail, nearest level, fractional level for each setting.
// Needs a current GL context. Throws Error as planning and rendering do.
void measureSpeedup(const World& world, const View& view, const SpeedupOptions& options,
                    const std::function<void(const SpeedupRow&)>& visit, const Progress& progress = {});

}  // namespace defocus
