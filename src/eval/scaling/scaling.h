#pragma once
// Measures how the time and the memory of a frame grow with triangles, instances, lens samples, pixels and blur, one at
// a time, at full detail and with fractional levels. Also finds the part of the work that bounds the time.
//
// Each frame is timed in three versions. The first is the complete frame. The second draws nothing, which leaves
// clearing and adding the layers. The third draws the same levels into an image of 1/40 the width and height, which
// leaves the work for each vertex and triangle. The rest of the complete frame is fill, the work for each pixel of a
// surface. On a GPU these parts overlap, so they show what bounds a frame, not what each part costs.
//
// Held equal along an axis: everything that the axis doesn't name (see scalingPoints), and the process. Runs alternate
// between modes. Times are medians of wall-clock times between finished frames, after one untimed frame.

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
    triangles,  // 100,000 … 10,000,000 in eight fish
    instances,  // 1 … 10,000 copies of one fish
    samples,    // 2 … 64
    pixels,     // 640 × 480 … 3840 × 2160
    blur,       // the largest circle of confusion, for f-numbers from 16 to 1
};

const char* scalingAxisName(ScalingAxis axis);  // the name on the command line

struct ScalingOptions {
    std::vector<ScalingAxis> axes = {ScalingAxis::triangles, ScalingAxis::instances, ScalingAxis::samples,
                                     ScalingAxis::pixels, ScalingAxis::blur};
    bool large = false;                 // true: the triangles go up to 50,000,000
    int runs = 3;                       // timed runs of each frame
    std::filesystem::path cacheFolder;  // for pyramids; empty for none
    RendererOptions renderer;
};

enum class ScalingPart { layers, vertices, fill };

const char* scalingPartName(ScalingPart part);

// A frame on an axis. The axis changes one value; the others are the defaults here.
struct ScalingPoint {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // number of triangles, instances, samples or pixels, or the f-number
    std::uint64_t triangles = 300'000;
    int instances = 0;  // 0 for the school, else the number of fish in the grid
    std::uint32_t samples = 8;
    int width = 640;
    int height = 480;
    std::optional<double> fStop;
};

std::vector<ScalingPoint> scalingPoints(ScalingAxis axis, bool large);

struct ScalingRow {
    ScalingAxis axis = ScalingAxis::triangles;
    double value = 0;  // value on the axis; px for blur
    LodMode mode = LodMode::off;
    std::uint32_t samples = 0;
    int width = 0;
    int height = 0;
    int runs = 0;
    Spread milliseconds;             // the complete frame
    Spread layers;                   // ms
    Spread vertices;                 // ms
    Spread fill;                     // ms; the rest of each run, ≥ 0
    std::uint64_t triangles = 0;     // drawn, over all samples
    std::uint64_t gpuBytes = 0;      // peak size of the renderer's resources
    std::uint64_t pyramidBytes = 0;  // main memory of all levels

    // Returns the part with the largest median and the parts that are too close to it to rank. Two parts are too close
    // if their spreads touch or their medians differ by less than a twentieth of the frame. The order is that of
    // ScalingPart.
    [[nodiscard]] std::vector<ScalingPart> largestParts() const;
};

// The times of a frame's runs in its three versions, ms. The three vectors have the same size.
struct ScalingTimes {
    std::vector<double> complete;
    std::vector<double> layers;    // nothing drawn
    std::vector<double> vertices;  // drawn into a small image
};

// Fills row.runs, milliseconds, layers, vertices and fill.
void setTimes(ScalingRow& row, const ScalingTimes& times);

struct ScalingVisitor {
    std::function<void(const ScalingRow&)> row;
    std::function<void(const ScalingPoint&, const std::string& reason)> leftOut;  // points that don't fit in memory
};

// Measures all points of the axes. Needs a current GL context.
void measureScaling(const ScalingOptions& options, const ScalingVisitor& visitor, const Progress& progress = {});

// The fit y ≈ factor · x^exponent by least squares of the logarithms.
struct PowerLaw {
    double exponent = 0;
    double residual = 0;  // root mean square of ln y − ln(factor · x^exponent), about a relative error
    std::size_t points = 0;
};

// Fits the upper half of the points: x at or above the geometric mean of the min and max x. Returns nothing if these
// points have fewer than two different x. All values must be > 0.
std::optional<PowerLaw> fittedPowerLaw(std::span<const std::pair<double, double>> points);

}  // namespace defocus::engine
