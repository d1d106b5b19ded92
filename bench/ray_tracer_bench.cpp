// Measures the Embree ray tracer: time per sample, and error against a converged image. Compares separate lens samples
// for each pixel with lens samples that all pixels share.
//
// Held constant: the unlit school of fish, view, lens, size, samples and process. Variants run alternately; the fastest
// run of each variant counts. CPU is the time of all threads, which depends less on other load. The RMSE is of
// display-encoded values at a quarter of the size, against a converged image with another seed.
//
//   defocus_ray_tracer_bench [--samples 32] [--size 1024x768] [--runs 5] [--reference-samples 2048] [--shading lit]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>
#include <span>

#include "embree/embree_renderer.h"
#include "image/metrics.h"
#include "run_bench.h"
#include "truth_scene.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

struct Options {
    std::uint32_t samples = 32;
    std::uint32_t referenceSamples = 2048;
    int runs = 5;
    int width = 1024;
    int height = 768;
    bool lit = false;
};

struct Row {
    const char* name;
    EmbreeSampling sampling;
    std::unique_ptr<Renderer> renderer;
    double milliseconds = std::numeric_limits<double>::infinity();  // time per lens sample
    double cpuMilliseconds = std::numeric_limits<double>::infinity();
};

FramePlan planOf(const View& view, std::uint32_t samples, std::uint32_t seed = 0) {
    FramePlan plan;
    plan.view = view;
    plan.settings.sampleCount = samples;
    plan.settings.seed = seed;
    return plan;
}

void renderOnce(Row& row, const FramePlan& plan) {
    row.renderer->start(plan);
    const std::clock_t before = std::clock();
    while (row.renderer->advance()) {
    }
    const double cpu = 1000.0 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    row.milliseconds = std::min(row.milliseconds, row.renderer->stats().renderMilliseconds / row.renderer->samples());
    row.cpuMilliseconds = std::min(row.cpuMilliseconds, cpu / row.renderer->samples());
}

void printErrors(const World& world, View view, std::span<const Row> rows, std::uint32_t referenceSamples) {
    view.width /= 4;
    view.height /= 4;
    const auto sampled = [&](EmbreeSampling sampling, std::uint32_t samples, std::uint32_t seed) {
        return imageOf(*makeEmbreeRenderer(world, sampling), planOf(view, samples, seed));
    };
    const Image reference = sampled(EmbreeSampling::perPixel, referenceSamples, 1'000'000);
    fmt::print("\nRMSE, {} x {}, against {} samples\n{:<15}", view.width, view.height, referenceSamples, "samples");
    constexpr std::array counts = {4u, 16u, 64u, 256u};
    for (const std::uint32_t count : counts) fmt::print(" {:>9}", count);
    fmt::print("\n");
    for (const Row& row : rows) {
        fmt::print("{:<15}", row.name);
        for (const std::uint32_t count : counts) {
            constexpr std::uint32_t seeds = 4;
            double error = 0;
            for (std::uint32_t seed = 0; seed < seeds; ++seed)
                error += compareImages(reference, sampled(row.sampling, count, seed)).rmse / seeds;
            fmt::print(" {:>9.5f}", error);
        }
        fmt::print("\n");
    }
}

int run(const Options& options) {
    const auto subject = truthScene(fishSchool(), options.width, options.height);
    if (options.lit) {
        subject->scene = fishSchool();
        const auto placed = chooseCamera(subject->scene, subject->world.pose, {}, 1.0 * options.width / options.height);
        subject->world.lights = lightsOrDefault(subject->scene, subject->world.pose, placed);
    }
    std::array<Row, 2> rows = {Row{"embree-shared", EmbreeSampling::shared, nullptr},
                               Row{"embree", EmbreeSampling::perPixel, nullptr}};
    for (Row& row : rows) row.renderer = makeEmbreeRenderer(subject->world, row.sampling);
    for (int i = 0; i < options.runs; ++i)
        for (Row& row : rows) renderOnce(row, planOf(subject->view, options.samples));

    const RenderStats stats = rows[0].renderer->stats();
    fmt::print("{}, {}\n{} fish school, {} x {}, {} samples, fastest of {} interleaved runs\n\n{:<15} {:>13} {:>13}\n",
               stats.device, stats.driver, options.lit ? "lit" : "unlit", options.width, options.height,
               options.samples, options.runs, "", "ms a sample", "CPU, ms");
    for (const Row& row : rows)
        fmt::print("{:<15} {:>13.1f} {:>13.1f}\n", row.name, row.milliseconds, row.cpuMilliseconds);
    if (options.referenceSamples > 0) printErrors(subject->world, subject->view, rows, options.referenceSamples);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    std::string size = "1024x768";
    CLI::App app("The time that the Embree ray tracer takes for a sample, and its error");
    app.add_option("--samples", options.samples, "lens samples a frame")->check(CLI::Range(1u, maxSamples));
    app.add_option("--runs", options.runs, "frames of each")->check(CLI::Range(1, 1000));
    app.add_option("--size", size, "WxH in px");
    app.add_option("--reference-samples", options.referenceSamples, "of the errors; 0: times only")
        ->check(CLI::Range(0u, maxSamples));
    app.add_option("--shading", options.lit, "unlit (colours of the vertices) or lit")
        ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"lit", true}, {"unlit", false}}));
    CLI11_PARSE(app, argc, argv);
    if (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 || options.width < 4 ||
        options.height < 4 || options.width > 16384 || options.height > 16384) {
        fmt::print(stderr, "--size {}: expected WxH, 4x4 to 16384x16384\n", size);
        return 2;
    }
    return runBench("defocus_ray_tracer_bench", [&] { return run(options); });
}
