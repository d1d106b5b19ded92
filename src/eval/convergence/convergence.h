#pragma once
// Error against run time: each method with each of its settings, over the number of lens samples, measured against a
// converged reference.
//
// Held equal: scene, camera, lens, image size, reference, process. The methods take turns: one frame of each, then the
// next pass over all, so that a machine that slows down slows all of them, and whoever stops early has all cases with
// fewer runs. Before a frame counts, its first wave is drawn once, so that shaders, uploads and the driver's caches are
// ready; nothing is pinned.
//
// A finished frame is a ConvergenceRun, which is handed out at once; convergence_rows.h makes medians of them.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/reference_image.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus {

struct ConvergenceOptions {
    std::vector<MethodUse> methods;  // empty: all of the table, with standard settings
    RenderSettings plan;             // of every case, but for what the lists below choose
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32, 64, 128, 256};  // of methods that use lens samples
    // Levels of detail of methods that draw levels. Without full detail among them, accumulation has it all the same.
    std::vector<LodMode> lods = {LodMode::off, LodMode::fractional};
    std::vector<LodMetric> metrics = {LodMetric::size};
    std::vector<double> thresholdFactors = {0.5, 1, 2};  // of defaultThresholds for the number of samples
    int runs = 3;                                        // of each case; 1 or more
    RendererOptions renderer;                            // its settings are not used
};

// What is measured: a method with one setting and one number of lens samples.
struct ConvergenceCase {
    MethodUse use;
    std::string setting;        // "lod=fractional metric=size thresholds=2", "components=5"; "standard": as it comes
    std::uint32_t samples = 0;  // lens samples asked for; 0: the method takes none
    RenderSettings plan;
    [[nodiscard]] bool usesLevels() const { return plan.lod != LodMode::off; }
};

// Few samples first, accumulation at full detail first of each number. Methods that take no lens samples have one case,
// among the first. Always there, asked for or not: accumulation at full detail and the ray tracers "embree" and
// "embree-shared", where the table has them. Post-process methods and ray tracers have full detail only.
std::vector<ConvergenceCase> convergenceCases(const ConvergenceOptions& options);

// An error as it is plotted: on display-encoded values, see metrics.h.
struct ImageError {
    double mse = 0;
    double ssim = 1;
    double flip = 0;
    [[nodiscard]] double psnr() const;  // dB; infinity for equal images
};

// One frame.
struct ConvergenceRun {
    std::string method;
    std::string setting;
    std::uint32_t asked = 0;         // lens samples; 0: the method takes none
    int run = 0;                     // from 0
    std::uint32_t samples = 0;       // drawn
    double pyramidMilliseconds = 0;  // set-up: the simplification of all meshes, where the case uses levels
    double setupMilliseconds = 0;    // set-up: of the renderer (uploads, shaders, ray tracer's hierarchies)
    double milliseconds = 0;         // the frame, wall clock
    double gpuMilliseconds = 0;      // timer queries; on a software driver these miss vertex work
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;  // resources held by the renderer, at their peak
    std::uint64_t imageHash = 0;
    ImageError error;                // from the reference
    std::optional<ImageError> bias;  // with levels: from full detail at the same lens samples
    std::string fault;               // why the image is not what it claims to be; empty: it is
};

// Whether both are of one case.
bool sameCase(const ConvergenceRun& run, const ConvergenceCase& wanted);

struct ConvergenceVisitor {
    // Each frame as soon as it is measured. `image` and its FLIP map come with the first frame of a case only.
    std::function<void(const ConvergenceRun& run, const Image* image, const Image* flipMap)> run;
    // A case that can't be measured here (a ray tracer without environment maps …) or could only show another image
    // than the reference's (Method::shadesAsLit, drawsMotion), and why. Others go on.
    std::function<void(const ConvergenceCase& wanted, const std::string& reason)> leftOut;
};

// Measures what `done`, the runs of an earlier call, doesn't have yet. `pyramidMilliseconds`: what the world's pyramids
// took. Needs a current GL context. Throws Error where accumulation at full detail can't be drawn.
void measureConvergence(const World& world, const View& view, const ReferenceImage& reference,
                        const ConvergenceOptions& options, double pyramidMilliseconds,
                        std::span<const ConvergenceRun> done, const ConvergenceVisitor& visitor,
                        const Progress& progress = {});

}  // namespace defocus
