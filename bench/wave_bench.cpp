// Measures the fixed time of a lens sample by layer format: clearing, compositing over a sky, adding and resolving,
// without any object.
//
// Held constant: 1024 × 768 px, 64 samples, an empty scene, program and process. Formats run alternately; the fastest
// run of each format counts. The number of samples drawn at once (wave size K) is 8, or the default, which depends on
// the format's memory. Prints a table and checks that every format gives the sky's colour.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "gl/context.h"
#include "render/methods.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int runs = 5;

struct Row {
    std::string format;
    std::uint32_t wave = 0;
    double milliseconds = std::numeric_limits<double>::infinity();  // time per lens sample
    double gigabytes = 0;
};

void measure(Renderer& renderer, const FramePlan& plan, float expected, Row& row) {
    drawAllSamples(renderer, plan);
    const RenderStats stats = renderer.stats();
    row.milliseconds = std::min(row.milliseconds, stats.renderMilliseconds / stats.samples);
    row.format = stats.layerFormat;
    row.wave = stats.wave;
    row.gigabytes = static_cast<double>(stats.peakBytes) / 1e9;
    const float value = renderer.image().at(0, 0)[1];
    if (std::abs(value - expected) > 2e-3f * expected)
        fail("{} K = {}: {} is not {}", row.format, row.wave, value, expected);
}

int run() {
    const auto context = createHeadlessContext();
    World world;
    world.scene = std::make_shared<const Scene>();
    View view;
    RenderSettings settings;
    settings.keepAll = true;  // keeps all lens samples in the plan although nothing is blurred
    fmt::print("{}, {}\n1024 x 768, 64 samples, nothing drawn, fastest of {} runs\n\n", context->device(),
               context->driver(), runs);
    fmt::print("{:<10} {:<10} {:>4} {:>14} {:>10}\n", "sky", "format", "K", "ms a sample", "GB");
    for (const EnvironmentType type : {EnvironmentType::uniform, EnvironmentType::gradient}) {
        const glm::vec3 colour(0.2f, 0.3f, 0.4f);
        world.environment = {type, colour, colour, colour, nullptr, 1};
        for (const LayerFormat format : {LayerFormat::rgba16f, LayerFormat::rgba32f})
            for (const std::uint32_t wave : {8u, 0u}) {
                RendererOptions options;
                options.layerFormat = format;
                options.wave = wave;
                const auto renderer = methodNamed("accumulation").make(world, options);
                const FramePlan plan = planFrame(world, view, settings);
                Row row;
                for (int i = 0; i < runs; ++i) measure(*renderer, plan, colour.g, row);
                fmt::print("{:<10} {:<10} {:>4} {:>14.2f} {:>10.2f}\n",
                           type == EnvironmentType::uniform ? "uniform" : "gradient", row.format, row.wave,
                           row.milliseconds, row.gigabytes);
            }
    }
    return 0;
}

}  // namespace

int main() {
    return defocus::engine::runBench("defocus_wave_bench", run);
}
