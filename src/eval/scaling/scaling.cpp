#include "eval/scaling/scaling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <ranges>

#include "core/enum_name.h"
#include "core/error.h"
#include "eval/machine.h"
#include "eval/scaling/worlds.h"

namespace defocus::engine {

namespace {

constexpr std::array comparedModes = {LodMode::off, LodMode::fractional};
constexpr int gridTriangles = 500;        // triangles of each fish in the grid at full detail
constexpr int smallFactor = 40;           // divides the image's width and height, so that mainly vertex work remains
constexpr double bytesPerTriangle = 600;  // main memory for the mesh, the build of its pyramid and the driver's copy
constexpr double memoryShareMax = 0.8;
constexpr double minMargin = 0.05;  // times that differ by less than this fraction of the frame time count as equal

FramePlan planOf(const ScalingWorld& world, const ScalingPoint& point, LodMode mode) {
    View view = world.view;
    view.width = point.width;
    view.height = point.height;
    view.lens.fStop = point.fStop.value_or(view.lens.fStop);
    const RenderSettings settings{.sampleCount = point.samples, .lod = mode};
    return planFrame(world.world, view, settings);
}

double milliseconds(Renderer& renderer, const FramePlan& plan) {
    drawAllSamples(renderer, plan);
    return renderer.stats().renderMilliseconds;
}

// The renderers, plans and times of a frame's three versions: complete, empty, and drawn into a small image. The
// complete and the empty frame share a renderer, so that render targets and programs are created once.
struct TimedMode {
    std::unique_ptr<Renderer> renderer;
    std::unique_ptr<Renderer> smallRenderer;
    FramePlan complete, empty, small;
    ScalingTimes times;

    void run(bool counts) {
        const double one[] = {milliseconds(*renderer, complete), milliseconds(*renderer, empty),
                              milliseconds(*smallRenderer, small)};
        if (!counts) return;
        times.complete.push_back(one[0]);
        times.layers.push_back(one[1]);
        times.vertices.push_back(one[2]);
    }
};

TimedMode timedMode(const ScalingWorld& world, const ScalingPoint& point, LodMode mode,
                    const RendererOptions& options) {
    const Method& method = methodNamed("accumulation");
    TimedMode timed;
    timed.renderer = method.make(world.world, options);
    timed.smallRenderer = method.make(world.world, options);
    timed.complete = planOf(world, point, mode);
    timed.empty = withoutObjects(timed.complete);
    timed.small = timed.complete;
    timed.small.view.width = std::max(1, point.width / smallFactor);
    timed.small.view.height = std::max(1, point.height / smallFactor);
    return timed;
}

double largestBlur(const FramePlan& plan) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects) largest = std::max(largest, object.coc.largest);
    return largest;
}

std::uint64_t pyramidBytes(const World& world) {
    std::uint64_t bytes = 0;
    for (const Pyramid& pyramid : world.pyramids.all()) {
        bytes += pyramid.indices.size() * sizeof(std::uint32_t);
        for (const PyramidLevel& level : pyramid.levels)
            bytes += level.positions.size() * sizeof(glm::vec3) + level.normals.size() * sizeof(glm::vec3) +
                     level.colors.size() * sizeof(glm::vec4) +
                     (level.uv0.size() + level.uv1.size()) * sizeof(glm::vec2);
    }
    return bytes;
}

ScalingRow rowOf(const ScalingWorld& world, const ScalingPoint& point, LodMode mode, const TimedMode& timed) {
    ScalingRow row;
    row.axis = point.axis;
    row.value = point.axis == ScalingAxis::blur ? largestBlur(timed.complete) : point.value;
    row.mode = mode;
    row.samples = static_cast<std::uint32_t>(timed.complete.samples.size());
    row.width = point.width;
    row.height = point.height;
    setTimes(row, timed.times);
    row.triangles = timed.complete.trianglesDrawn;
    row.gpuBytes = timed.renderer->stats().peakBytes;
    row.pyramidBytes = pyramidBytes(world.world);
    return row;
}

void measurePoint(const ScalingWorld& world, const ScalingPoint& point, const ScalingOptions& options,
                  const ScalingVisitor& visitor) {
    std::array<TimedMode, comparedModes.size()> timed;
    for (std::size_t m = 0; m < comparedModes.size(); ++m)
        timed[m] = timedMode(world, point, comparedModes[m], options.renderer);
    for (int i = 0; i <= options.runs; ++i)
        for (TimedMode& mode : timed) mode.run(i > 0);
    for (std::size_t m = 0; m < comparedModes.size(); ++m) visitor.row(rowOf(world, point, comparedModes[m], timed[m]));
}

bool sameWorld(const ScalingPoint& a, const ScalingPoint& b) {
    return a.triangles == b.triangles && a.instances == b.instances;
}

// Returns the reason why the frame of `point` doesn't fit into this machine's memory; empty if it fits.
std::string tooLarge(const ScalingPoint& point, const Machine& machine) {
    const double needed = bytesPerTriangle * static_cast<double>(point.triangles);
    const double max = memoryShareMax * static_cast<double>(machine.memoryBytes);
    if (machine.memoryBytes == 0 || point.instances > 0 || needed <= max) return {};
    return fmt::format("about {:.0f} GB of main memory needed", needed / 1e9);
}

// The scaling point that was measured last, and its world (scene, pyramids and view). The next point reuses the world
// if it needs the same one.
struct Subject {
    Machine machine;
    ScalingPoint point;
    std::unique_ptr<ScalingWorld> world;
};

// Measures one point: one value of the parameter that its axis varies. Returns why the measurement failed; empty on
// success.
std::string measuredOrWhyNot(Subject& subject, const ScalingPoint& point, const ScalingOptions& options,
                             const ScalingVisitor& visitor, const Progress& progress) {
    std::string reason = tooLarge(point, subject.machine);
    if (!reason.empty()) return reason;
    try {
        if (!subject.world || !sameWorld(point, subject.point)) {
            subject.world.reset();  // freed first, because two worlds may not fit into memory
            subject.world = std::make_unique<ScalingWorld>(
                point.instances > 0 ? gridOf(point.instances, gridTriangles, options.cacheFolder)
                                    : schoolOf(point.triangles, options.cacheFolder, progress));
            subject.point = point;
        }
        measurePoint(*subject.world, point, options, visitor);
    } catch (const Error& error) {  // for example, because graphics memory is full
        reason = error.what();
    } catch (const std::bad_alloc&) {
        reason = "main memory is exhausted";
    }
    if (!reason.empty()) subject.world.reset();
    return reason;
}

}  // namespace

const char* scalingAxisName(ScalingAxis axis) {
    return enumName<ScalingAxis::blur>(axis, {"triangles", "instances", "samples", "pixels", "blur"});
}

const char* scalingPartName(ScalingPart part) {
    return enumName<ScalingPart::fill>(part, {"adding layers", "vertex work", "fill"});
}

std::vector<ScalingPoint> scalingPoints(ScalingAxis axis, bool large) {
    std::vector<ScalingPoint> points;
    const auto add = [&](double value) -> ScalingPoint& {
        ScalingPoint& point = points.emplace_back();
        point.axis = axis;
        point.value = value;
        return point;
    };
    switch (axis) {
        case ScalingAxis::triangles: {
            std::vector<std::uint64_t> counts = {100'000, 300'000, 1'000'000, 3'000'000, 10'000'000};
            if (large) counts.insert(counts.end(), {20'000'000, 50'000'000});
            for (const std::uint64_t count : counts) add(static_cast<double>(count)).triangles = count;
            break;
        }
        case ScalingAxis::instances:
            for (const int count : {1, 10, 100, 1'000, 10'000}) add(count).instances = count;
            break;
        case ScalingAxis::samples:
            for (const std::uint32_t count : {2u, 4u, 8u, 16u, 32u, 64u}) add(count).samples = count;
            break;
        case ScalingAxis::pixels:
            for (const auto& [width, height] : {std::pair{640, 480}, std::pair{1280, 720}, std::pair{1920, 1080},
                                                std::pair{2560, 1440}, std::pair{3840, 2160}}) {
                ScalingPoint& point = add(static_cast<double>(width) * height);
                point.width = width;
                point.height = height;
            }
            break;
        case ScalingAxis::blur:
            for (const double fStop : {16.0, 8.0, 4.0, 2.0, 1.0}) add(fStop).fStop = fStop;
            break;
    }
    return points;
}

std::vector<ScalingPart> ScalingRow::largestParts() const {
    constexpr std::array parts = {ScalingPart::layers, ScalingPart::vertices, ScalingPart::fill};
    const std::array<const Spread*, 3> times = {&layers, &vertices, &fill};
    const Spread& largest = **std::ranges::max_element(times, {}, [](const Spread* time) { return time->median; });
    std::vector<ScalingPart> found;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool touches = times[i]->high >= largest.low;
        const bool close = largest.median - times[i]->median < minMargin * milliseconds.median;
        if (touches || close) found.push_back(parts[i]);
    }
    return found;
}

void setTimes(ScalingRow& row, const ScalingTimes& times) {
    std::vector<double> fill;
    for (std::size_t i = 0; i < times.complete.size(); ++i)
        fill.push_back(std::max(0.0, times.complete[i] - times.layers[i] - times.vertices[i]));
    row.runs = static_cast<int>(times.complete.size());
    row.milliseconds = spreadOf(times.complete);
    row.layers = spreadOf(times.layers);
    row.vertices = spreadOf(times.vertices);
    row.fill = spreadOf(fill);
}

void measureScaling(const ScalingOptions& options, const ScalingVisitor& visitor, const Progress& progress) {
    std::vector<ScalingPoint> points;
    for (const ScalingAxis axis : options.axes)
        for (const ScalingPoint& point : scalingPoints(axis, options.large)) points.push_back(point);

    Subject subject{thisMachine(), {}, {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        report(progress, "points", i, points.size());
        const std::string reason = measuredOrWhyNot(subject, points[i], options, visitor, progress);
        if (!reason.empty()) visitor.leftOut(points[i], reason);
    }
}

std::optional<PowerLaw> fittedPowerLaw(std::span<const std::pair<double, double>> points) {
    if (points.empty()) return {};
    const auto [min, largest] = std::ranges::minmax(points | std::views::keys);
    const double from = std::sqrt(min * largest) * (1 - 1e-9);
    double n = 0, sumX = 0, sumY = 0, sumXx = 0, sumXy = 0;
    for (const auto& [x, y] : points) {
        if (x < from) continue;
        const double lx = std::log(x / largest);
        const double ly = std::log(y);
        n += 1;
        sumX += lx;
        sumY += ly;
        sumXx += lx * lx;
        sumXy += lx * ly;
    }
    const double spread = sumXx - sumX * sumX / n;
    if (!(spread > 1e-12)) return {};
    PowerLaw law;
    law.exponent = (sumXy - sumX * sumY / n) / spread;
    law.points = static_cast<std::size_t>(n);
    double squared = 0;
    for (const auto& [x, y] : points) {
        if (x < from) continue;
        const double expected = sumY / n + law.exponent * (std::log(x / largest) - sumX / n);
        squared += (std::log(y) - expected) * (std::log(y) - expected);
    }
    law.residual = std::sqrt(squared / n);
    return law;
}

}  // namespace defocus::engine
