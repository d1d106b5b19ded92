#pragma once
// Measures how a frame's time and memory grow with triangles, instances, lens samples, pixels and blur, one at a time,
// at full detail and with fractional levels. Also finds which part of the work limits the frame time.
//
// Three versions of each frame are timed. The first is the complete frame. The second is an empty frame, in which the
// layers (one image per sample) are only cleared and summed. The third draws the same levels into an image of 1/40 the
// width and height, so that mainly the work per vertex and triangle remains. The rest of the complete frame's time is
// fill, the work per pixel of a surface. On a GPU these parts overlap, so they show which part limits a frame, not the
// cost of each part.
//
// Triangles, instances, lens samples, pixels and blur are the axes of the benchmark. Along an axis, all parameters that
// it doesn't vary (see scalingPoints) stay constant; all points are measured in one process. Runs at full detail and
// runs with fractional levels take turns. Times are medians of the wall-clock time between finished frames, after one
// untimed frame.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "eval/spread.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus::engine {

enum class ScalingAxis {
    triangles,  // numbers of triangles in eight fish, from 100,000 to 10,000,000
    instances,  // numbers of instances of one fish, from 1 to 10,000
    samples,    // numbers of lens samples from 2 to 64
    pixels,     // image sizes from 640 × 480 to 3840 × 2160 px
    blur,       // f-numbers from 16 to 1
};

const char* scalingAxisName(ScalingAxis axis);  // returns the axis's name on the command line

struct ScalingOptions {
    std::vector<ScalingAxis> axes = {ScalingAxis::triangles, ScalingAxis::instances, ScalingAxis::samples,
                                     ScalingAxis::pixels, ScalingAxis::blur};
    bool large = false;                 // true: extends the triangles axis to 50,000,000
    int runs = 3;                       // timed runs of each frame
    std::filesystem::path cacheFolder;  // cache of the pyramids; empty: no cache
    RendererOptions renderer;
};

enum class ScalingPart { layers, vertices, fill };

const char* scalingPartName(ScalingPart part);

// Parameters of a frame to measure. Each axis varies one parameter, or width and height; the others keep their
// defaults.
struct ScalingPoint {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // number of triangles, instances, samples or pixels, or the f-number
    std::uint64_t triangles = 300'000;
    int instances = 0;  // number of fish in the grid; 0: draws the built-in school of fish instead
    std::uint32_t samples = 8;
    int width = 640;
    int height = 480;
    std::optional<double> fStop;
};

std::vector<ScalingPoint> scalingPoints(ScalingAxis axis, bool large);

struct ScalingRow {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // ScalingPoint::value; for ScalingAxis::blur: largest CoC diameter, px
    LodMode mode = LodMode::off;
    std::uint32_t samples = 0;
    int width = 0;
    int height = 0;
    int runs = 0;
    Spread milliseconds;             // time of the complete frame, ms
    Spread layers;                   // time of the empty frame, ms: layers are only cleared and summed
    Spread vertices;                 // time of the frame drawn into a small image, ms: mainly work per vertex
    Spread fill;                     // rest of the complete frame's time, ≥ 0, ms: mainly work per pixel of a surface
    std::uint64_t triangles = 0;     // drawn triangles, sum over all samples
    std::uint64_t gpuBytes = 0;      // peak size of the renderer's resources
    std::uint64_t pyramidBytes = 0;  // main memory of all levels of all meshes

    // Returns the slowest part of the frame (by median) and each part that is about as slow, in the order of
    // ScalingPart. A part is about as slow if its spread overlaps the spread of the slowest part, or if its median is
    // lower by less than a twentieth of the frame time.
    [[nodiscard]] std::vector<ScalingPart> largestParts() const;
};

// Times (ms) of the three timed versions of a frame: complete, empty, and drawn into a small image. Each vector has one
// element per run.
struct ScalingTimes {
    std::vector<double> complete;
    std::vector<double> layers;    // times of the empty frame
    std::vector<double> vertices;  // times of the frame drawn into a small image
};

// Sets the members `runs`, `milliseconds`, `layers`, `vertices` and `fill` of the row.
void setTimes(ScalingRow& row, const ScalingTimes& times);

struct ScalingVisitor {
    std::function<void(const ScalingRow&)> row;
    // Called with each scaling point that is skipped because its frame does not fit into memory, and with the reason.
    std::function<void(const ScalingPoint&, const std::string& reason)> leftOut;
};

// Measures all points of the requested axes. Needs a current GL context.
void measureScaling(const ScalingOptions& options, const ScalingVisitor& visitor, const Progress& progress = {});

// A power law y ≈ factor · x^exponent, fitted by least squares to the logarithms of x and y.
struct PowerLaw {
    double exponent = 0;
    double residual = 0;  // RMS of ln y − ln(factor · x^exponent): approximately the relative RMS error
    std::size_t points = 0;
};

// Fits a power law to the points with x at or above the geometric mean of the min and max x. Returns nullopt if these
// points have fewer than two distinct x. All values must be > 0.
std::optional<PowerLaw> fittedPowerLaw(std::span<const std::pair<double, double>> points);

}  // namespace defocus::engine
