// Compares sets of lens points: the selectable sequences, and patterns that depend on the number of points. The
// patterns are Vogel's spiral, rings of points, and a set relaxed to blue noise.
//
// For the first table, the fraction of the points inside a region estimates the region's area. The table shows the
// errors of these estimates, for regions of the lens and of the pixel. The second table shows image errors by number of
// lens samples. Held constant: scene, camera, lens, full detail, 32-bit layers, and one reference per scene. The
// reference has 4,096 samples from a separate part of the Halton sequence. Errors are combined over the seeds 0 and 1:
// the RMSE of display-encoded values by the root mean square, FLIP by the mean. The patterns are used on the lens only;
// their points in the pixel come from `sobol`.
//
//   defocus_sequence_bench [MODEL…]
//
// Without models, renders a small school of fish, meshes/bokeh.gltf and meshes/staircase.gltf.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "frame/driver/reference_image.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "image/metrics.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "run_bench.h"

namespace defocus::engine {
namespace {

constexpr std::uint32_t referenceSamples = 4096;
constexpr std::uint32_t seeds = 2;
constexpr double fullTurn = 2 * std::numbers::pi;
const std::vector<std::uint32_t> counts = {8, 16, 32, 64, 128, 256, 512, 1024};

struct Pattern {
    std::string name;
    bool needsCount = false;  // true: points depend on their count N, so the first n < N are unevenly spread
    std::function<std::vector<LensSample>(std::uint32_t count, std::uint32_t seed)> samples;
};

// ---- sets with a given number of points -----------------------------------------------------------------------------

glm::dvec2 polar(double radius, double angle) {
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

// Returns points on the spiral of Vogel 1979, A Better Way to Construct the Sunflower Head.
std::vector<glm::dvec2> vogelSpiral(std::uint32_t count, std::uint32_t seed) {
    const double golden = fullTurn * (2 - std::numbers::phi);
    std::vector<glm::dvec2> points;
    for (std::uint32_t i = 0; i < count; ++i) points.push_back(polar(std::sqrt((i + 0.5) / count), golden * i + seed));
    return points;
}

// Returns rings of 1, 6, 12, 18 … points, as in a hexagonal grid; the last ring gets the remaining points. The radii
// give all points the same area of the disk.
std::vector<glm::dvec2> hexagonalRings(std::uint32_t count, std::uint32_t seed) {
    std::vector<glm::dvec2> points;
    std::uint32_t size = 1;
    for (std::uint32_t before = 0; before < count; before += size, size = size == 1 ? 6 : size + 6) {
        size = std::min(size, count - before);
        const double radius = before == 0 ? 0 : std::sqrt((before + 0.5 * size) / count);
        for (std::uint32_t i = 0; i < size; ++i) points.push_back(polar(radius, fullTurn * i / size + before + seed));
    }
    return points;
}

// Returns points of the unit disk, mapped from points of the unit square that repel each other. These begin as Sobol'
// points; their distances wrap around at the edges of the square.
std::vector<glm::dvec2> relaxed(std::uint32_t count, std::uint32_t seed) {
    std::vector<glm::dvec2> square;
    for (std::uint32_t i = 0; i < count; ++i) square.push_back(sequencePoint(Sequence::sobol, i, seed + 1).lens);
    const double reach = 1.5 / std::sqrt(count);
    for (int step = 0; step < 40; ++step) {
        std::vector<glm::dvec2> moved = square;
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t j = 0; j < count; ++j) {
                const glm::dvec2 apart = square[i] - square[j];
                const glm::dvec2 away(apart.x - std::round(apart.x), apart.y - std::round(apart.y));
                const double distance = glm::length(away);
                if (distance < reach && distance > 0) moved[i] += 0.05 * (reach - distance) / distance * away;
            }
        for (glm::dvec2& p : moved) p = {p.x - std::floor(p.x), p.y - std::floor(p.y)};
        square = moved;
    }
    for (glm::dvec2& p : square) p = concentricDisk(p);
    return square;
}

Pattern patternOf(const char* name, std::vector<glm::dvec2> (*points)(std::uint32_t, std::uint32_t)) {
    return {name, true, [points](std::uint32_t count, std::uint32_t seed) {
                std::vector<LensSample> samples = lensSamples(Lens{}, Sequence::sobol, 0, count, seed);
                const std::vector<glm::dvec2> lens = points(count, seed);
                for (std::size_t i = 0; i < samples.size(); ++i) samples[i].lens = glm::vec2(lens[i]);
                return samples;
            }};
}

std::vector<Pattern> patterns() {
    std::vector<Pattern> list;
    for (const Sequence sequence : allSequences)
        list.push_back({std::string(sequenceName(sequence)), false, [=](std::uint32_t count, std::uint32_t seed) {
                            return lensSamples(Lens{}, sequence, 0, count, seed);
                        }});
    list.push_back(patternOf("(vogel's spiral)", vogelSpiral));
    list.push_back(patternOf("(hexagonal rings)", hexagonalRings));
    list.push_back(patternOf("(relaxed)", relaxed));
    return list;
}

// ---- errors of areas estimated from points, without rendering -------------------------------------------------------

struct Region {
    double area = 0;  // area of the region, as a fraction of the lens or pixel area
    std::function<bool(const LensSample&)> holds;
};

// Returns half planes that cut the lens. A background point beside a straight blurred edge is visible from such a part
// of the lens.
std::vector<Region> halfPlanes() {
    std::vector<Region> regions;
    for (int direction = 0; direction < 32; ++direction)
        for (int offset = -7; offset <= 7; ++offset) {
            const glm::vec2 normal(polar(1, fullTurn * (direction + 0.3) / 32));
            const double h = offset / 8.0;
            regions.push_back({(std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi,
                               [=](const LensSample& s) { return static_cast<double>(glm::dot(s.lens, normal)) > h; }});
        }
    return regions;
}

// Returns rectangles in the pixel that share its lower left corner.
std::vector<Region> boxes() {
    std::vector<Region> regions;
    for (int x = 1; x <= 16; ++x)
        for (int y = 1; y <= 16; ++y)
            regions.push_back({x * y / 256.0, [right = x / 16.0f - 0.5f, top = y / 16.0f - 0.5f](const LensSample& s) {
                                   return s.pixel.x < right && s.pixel.y < top;
                               }});
    return regions;
}

// Errors of region areas that are estimated from a point set: the fraction of the points inside a region, minus the
// region's area.
struct Discrepancy {
    double all = 0;     // RMS error over all regions
    double prefix = 0;  // max |error| over all regions and all n ≥ 16, using only the first n points
    double suffix = 0;  // max |error| over all regions and all n ≥ 16, using only the last n points
};

double largestOfPrefixes(const std::vector<LensSample>& samples, const Region& region) {
    double largest = 0;
    double inside = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        inside += region.holds(samples[i]) ? 1 : 0;
        if (i >= 15) largest = std::max(largest, std::abs(inside / static_cast<double>(i + 1) - region.area));
    }
    return largest;
}

Discrepancy discrepancyOf(std::vector<LensSample> samples, const std::vector<Region>& regions) {
    Discrepancy result;
    for (const Region& region : regions) {
        const auto inside = static_cast<double>(std::count_if(samples.begin(), samples.end(), region.holds));
        const double error = inside / static_cast<double>(samples.size()) - region.area;
        result.all += error * error / static_cast<double>(regions.size());
        result.prefix = std::max(result.prefix, largestOfPrefixes(samples, region));
    }
    std::reverse(samples.begin(), samples.end());
    for (const Region& region : regions) result.suffix = std::max(result.suffix, largestOfPrefixes(samples, region));
    result.all = std::sqrt(result.all);
    return result;
}

double nanosecondsASample(const Pattern& pattern) {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t made = pattern.samples(1024, 5).size();
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / static_cast<double>(made);
}

void measurePoints() {
    const std::vector<Region> lens = halfPlanes();
    const std::vector<Region> pixel = boxes();
    fmt::print(
        "Points alone, errors of areas in 1/1000, mean over the seeds: rms over half planes of the lens by the number "
        "of\n"
        "samples; largest over them in all prefixes and suffixes (16 samples and more) of 64; the mean's distance "
        "from\n"
        "the lens's centre; the same rms and largest for boxes of the pixel; what a sample takes to make\n\n"
        "{:<18}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>9}{:>9}{:>9}{:>8}\n{:<18}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>9}"
        "{:>9}{:>9}{:>8}\n",
        "", "lens 16", "32", "64", "256", "prefixes", "suffixes", "mean", "pixel 64", "prefixes", "suffixes", "ns", "",
        "", "", "", "", "of 64", "of 64", "of 64", "", "of 64", "of 64", "");
    for (const Pattern& pattern : patterns()) {
        std::vector<double> row(10);
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            const auto add = [&](std::size_t column, double value) { row[column] += 1000 * value / seeds; };
            std::size_t column = 0;
            for (const std::uint32_t count : {16u, 32u, 64u, 256u})
                add(column++, discrepancyOf(pattern.samples(count, seed), lens).all);
            const std::vector<LensSample> samples = pattern.samples(64, seed);
            const Discrepancy onLens = discrepancyOf(samples, lens);
            const Discrepancy inPixel = discrepancyOf(samples, pixel);
            glm::dvec2 mean(0);
            for (const LensSample& s : samples) mean += glm::dvec2(s.lens) / 64.0;
            for (const double value :
                 {onLens.prefix, onLens.suffix, glm::length(mean), inPixel.all, inPixel.prefix, inPixel.suffix})
                add(column++, value);
        }
        fmt::print("{:<18}", pattern.name);
        for (std::size_t i = 0; i < row.size(); ++i) fmt::print("{:>{}.1f}", row[i], i < 4 || i == 6 ? 8 : 9);
        fmt::print("{:>8.0f}\n", nanosecondsASample(pattern));
    }
}

// ---- rendered images ------------------------------------------------------------------------------------------------

RendererOptions precise() {
    // a batch (wave) of 8 samples allows reading the image after every 8 samples
    return {.layerFormat = LayerFormat::rgba32f, .wave = 8};
}

RenderSettings fullDetailSettings(const PreparedFrame& frame, std::uint32_t count) {
    RenderSettings settings = frame.settings;
    settings.sampleCount = count;
    settings.lod = LodMode::off;
    settings.keepAll = true;
    return settings;
}

// Renders a plan once. Returns the images after reads[0], reads[1] … samples; `reads` is ascending. If `samples` isn't
// empty, it replaces the plan's samples.
std::vector<Image> rendered(Renderer& renderer, FramePlan plan, const std::vector<LensSample>& samples,
                            const std::vector<std::uint32_t>& reads) {
    if (!samples.empty()) plan.samples = samples;
    std::vector<Image> images;
    renderer.start(plan);
    bool more = true;
    while (more) {
        more = renderer.advance();
        if (images.size() < reads.size() && renderer.samples() == reads[images.size()])
            images.push_back(renderer.image());
    }
    if (images.size() != reads.size()) fail("the renderer stopped before {} samples", reads.back());
    return images;
}

struct Errors {
    std::vector<double> square;  // squared RMSE, averaged over the seeds, by sample count
    std::vector<double> flip;
};

Errors errorsOf(const Pattern& pattern, Renderer& renderer, const PreparedFrame& frame, const Image& reference) {
    Errors errors{std::vector<double>(counts.size()), std::vector<double>(counts.size())};
    const auto add = [&](std::size_t i, const Image& image) {
        const Difference difference = compareImages(reference, image);
        errors.square[i] += difference.rmse * difference.rmse / seeds;
        errors.flip[i] += difference.flip / seeds;
    };
    const auto planOf = [&](std::uint32_t count) {
        return planFrame(frame.world, frame.view, fullDetailSettings(frame, count));
    };
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        if (!pattern.needsCount) {
            const std::vector<LensSample> samples = pattern.samples(counts.back(), seed);
            const std::vector<Image> images = rendered(renderer, planOf(counts.back()), samples, counts);
            for (std::size_t i = 0; i < counts.size(); ++i) add(i, images[i]);
            continue;
        }
        for (std::size_t i = 0; i < counts.size(); ++i)
            add(i, rendered(renderer, planOf(counts[i]), pattern.samples(counts[i], seed), {counts[i]}).front());
    }
    return errors;
}

void measureImages(const Request& options) {
    const PreparedFrame frame = prepareFrame(options);
    const auto renderer = makeAccumulationRenderer(frame.world, precise());
    RenderSettings settings = fullDetailSettings(frame, referenceSamples);
    settings.sequence = referenceSequence;
    settings.firstSample = referenceOffset;
    const Image reference =
        rendered(*renderer, planFrame(frame.world, frame.view, settings), {}, {referenceSamples}).front();

    fmt::print("\n{}, {} x {} px, f/{:g}: 1000 RMSE (1000 FLIP) by lens samples; ms a sample\n\n{:<18}",
               frame.sceneName, options.size.width, options.size.height, frame.view.lens.fStop, "");
    for (const std::uint32_t count : counts) fmt::print("{:>15}", count);
    fmt::print("{:>8}\n", "ms");
    for (const Pattern& pattern : patterns()) {
        const Errors errors = errorsOf(pattern, *renderer, frame, reference);
        fmt::print("{:<18}", pattern.name);
        for (std::size_t i = 0; i < counts.size(); ++i)
            fmt::print("{:>15}",
                       fmt::format("{:.2f} ({:.1f})", 1000 * std::sqrt(errors.square[i]), 1000 * errors.flip[i]));
        fmt::print("{:>8.2f}\n", renderer->stats().renderMilliseconds / renderer->samples());
        std::fflush(stdout);
    }
}

void run(int argc, char** argv) {
    const auto context = createHeadlessContext();
    fmt::print("{}, {}\n\n", context->device(), context->driver());
    measurePoints();
    std::fflush(stdout);
    Request options;
    options.size.width = 160;
    options.size.height = 120;
    options.fishCount = 8;
    options.trianglesPerFish = 2000;
    options.lens.fStop = 0.95;
    std::vector<std::filesystem::path> scenes(argv + 1, argv + argc);
    if (scenes.empty())
        scenes = {"", DEFOCUS_SOURCE_DIR "/meshes/bokeh.gltf", DEFOCUS_SOURCE_DIR "/meshes/staircase.gltf"};
    for (const std::filesystem::path& scene : scenes) {
        options.scene = scene;
        measureImages(options);
    }
}

}  // namespace
}  // namespace defocus::engine

int main(int argc, char** argv) {
    return defocus::engine::runBench("defocus_sequence_bench", [&] {
        defocus::engine::run(argc, argv);
        return 0;
    });
}
