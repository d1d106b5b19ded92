#pragma once
// How the time and the memory of a frame grow with triangles, instances, lens samples, pixels and blur, each by itself,
// at full detail and with fractional levels; and what bounds them.
//
// A frame is timed thrice over: whole; with nothing drawn, which leaves clearing and adding the layers; and the same
// draws, levels included, into an image of 1/40 the width and height, which leaves the work a vertex and a triangle.
// What is left of the whole frame is fill: what is done for each pixel of a surface. On hardware these overlap, so that
// the parts say what bounds a frame, not what each costs.
//
// Held equal along an axis: all that the axis doesn't name (see scalingPoints), and the process. Runs alternate between
// modes. Times are medians of wall-clock times between finished frames, after a frame that isn't counted.

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

namespace defocus {

enum class ScalingAxis {
    triangles,  // 100,000 … 10,000,000 of eight fish
    instances,  // 1 … 10,000 of one fish
    samples,    // 2 … 64
    pixels,     // 640 × 480 … 3840 × 2160
    blur,       // the largest circle of confusion, by f-numbers from 16 to 1
};

const char* scalingAxisName(ScalingAxis axis);  // as the command line has it

struct ScalingOptions {
    std::vector<ScalingAxis> axes = {ScalingAxis::triangles, ScalingAxis::instances, ScalingAxis::samples,
                                     ScalingAxis::pixels, ScalingAxis::blur};
    bool large = false;                 // triangles up to 50,000,000
    int runs = 3;                       // that count, of each frame
    std::filesystem::path cacheFolder;  // of pyramids; empty: none
    RendererOptions renderer;
};

enum class ScalingPart { layers, vertices, fill };

const char* scalingPartName(ScalingPart part);

// A frame on an axis; what it doesn't say is as in its first point.
struct ScalingPoint {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // triangles, instances, samples, pixels or the f-number
    std::uint64_t triangles = 300'000;
    int instances = 0;  // 0: the school, else the grid
    std::uint32_t samples = 8;
    int width = 640;
    int height = 480;
    std::optional<double> fStop;
};

std::vector<ScalingPoint> scalingPoints(ScalingAxis axis, bool large);

struct ScalingRow {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // what the axis counts; for blur: px
    LodMode mode = LodMode::off;
    std::uint32_t samples = 0;
    int width = 0;
    int height = 0;
    int runs = 0;
    Spread milliseconds;             // the whole frame
    Spread layers;                   // ms
    Spread vertices;                 // ms
    Spread fill;                     // ms; the rest of each run, 0 or more
    std::uint64_t triangles = 0;     // drawn, over all samples
    std::uint64_t gpuBytes = 0;      // held by the renderer, at their peak
    std::uint64_t pyramidBytes = 0;  // of all levels, in main memory

    // The part with the largest median, and those that can't be told from it: their spreads touch, or their medians
    // differ by less than a twentieth of the frame. In the order of ScalingPart.
    [[nodiscard]] std::vector<ScalingPart> largestParts() const;
};

// A frame's runs in its three versions, ms, as many of each.
struct ScalingTimes {
    std::vector<double> whole;
    std::vector<double> layers;    // nothing drawn
    std::vector<double> vertices;  // drawn into a small image
};

// Fills runs, milliseconds, layers, vertices and fill.
void setTimes(ScalingRow& row, const ScalingTimes& times);

struct ScalingVisitor {
    std::function<void(const ScalingRow&)> row;
    std::function<void(const ScalingPoint&, const std::string& reason)> leftOut;  // memory didn't allow it
};

// Needs a current GL context.
void measureScaling(const ScalingOptions& options, const ScalingVisitor& visitor, const Progress& progress = {});

// y ≈ factor · x^exponent by least squares of the logarithms.
struct PowerLaw {
    double exponent = 0;
    double residual = 0;  // root mean square of ln y − ln(factor · x^exponent): about a relative error
    std::size_t points = 0;
};

// Over the upper half of the points: those with x of at least the geometric mean of the least and the largest. None
// with fewer than two different x there. All values above 0.
std::optional<PowerLaw> fittedPowerLaw(std::span<const std::pair<double, double>> points);

}  // namespace defocus
