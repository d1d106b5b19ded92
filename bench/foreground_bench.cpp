// Measures the time that a limit on the foreground blur saves (Munkberg, Toth and Akenine-Möller 2012), in two scenes.
// The first is seen through leaves that nearly touch the lens, as in their Figure 7. The second is a game of chess with
// a moving queen in front, as in their Figure 4. The rasteriser draws the scene once per lens sample, so the number of
// pixels that a triangle covers doesn't grow with the blur. A limit saves only the work for triangles that lie outside
// the image and would be blurred into the image. On the other hand, objects with less blur use finer levels of detail.
//
//   defocus_foreground_bench [--stochastic]   --stochastic: measures only method "stochastic"
//
// Held constant: camera, lens, size, lens samples, renderer and process. Runs of all limits alternate; the table has
// the fastest run for each limit. Column "CPU" is the CPU time of all threads, which depends less on other load.
// Columns "work" and "most" are the mean and the max over the heat map of --aov work: the number of triangles that
// cover a pixel, per lens sample.
//
// Then measures method "stochastic", with the circle of confusion interpolated linearly inside triangles, as in the
// paper. The table has the time and the number of triangles tested for each ray, which is the paper's measure of work.
// Each ray passes through a small part of the lens. The method tests the ray only against triangles that this part of
// the lens can see, and skips triangles behind the nearest hit.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "render/accumulation/accumulation.h"
#include "render/aov/work.h"
#include "render/methods.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int runs = 5;
constexpr int stochasticRuns = 3;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Row {
    LodMode lod = LodMode::off;
    double limit = infinity;  // limit on the foreground blur, px
    FramePlan plan;
    double milliseconds = infinity;
    double cpuMilliseconds = infinity;
};

void renderOnce(const World& world, Row& row) {
    const auto renderer = makeAccumulationRenderer(world, {});
    renderer->start(row.plan);
    const std::clock_t before = std::clock();
    while (renderer->advance()) {
    }
    row.milliseconds = std::min(row.milliseconds, renderer->stats().renderMilliseconds);
    row.cpuMilliseconds =
        std::min(row.cpuMilliseconds, 1000.0 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
}

struct Figure {
    const char* scene;
    double time;     // time in the animation, s
    double shutter;  // exposure, s
    std::vector<double> limits;
};

void print(const PreparedFrame& frame, const Row& row, const Row& unlimited) {
    const auto samples = static_cast<std::uint32_t>(row.plan.samples.size());
    const WorkSummary work = workSummary(renderWork(frame.world, row.plan), samples);
    fmt::print("{:<12} {:>10} {:>10.0f} {:>7.2f} {:>10.0f} {:>7.2f} {:>14.2f} {:>8.2f} {:>8.1f}\n",
               lodModeName(row.lod), std::isinf(row.limit) ? "none" : fmt::format("{:.0f}", row.limit),
               row.milliseconds, unlimited.milliseconds / row.milliseconds, row.cpuMilliseconds,
               unlimited.cpuMilliseconds / row.cpuMilliseconds, static_cast<double>(row.plan.trianglesDrawn) / 1e6,
               work.mean, work.max);
}

void measure(const Figure& figure) {
    Request options;
    options.scene = std::string(DEFOCUS_SOURCE_DIR "/") + figure.scene;
    options.size.width = 512;
    options.size.height = 384;
    options.time = figure.time;
    options.shutter = figure.shutter;
    PreparedFrame frame = prepareFrame(options);
    fmt::print("\n{}, {} x {}, {} samples, shutter {:.3g} s, fastest of {} interleaved runs\n\n", figure.scene,
               frame.view.width, frame.view.height, frame.settings.sampleCount, figure.shutter, runs);
    std::vector<Row> rows;
    for (const LodMode lod : {LodMode::off, LodMode::fractional})
        for (const double limit : figure.limits) {
            View view = frame.view;
            view.lens.foregroundLimit = limit;
            RenderSettings settings = frame.settings;
            settings.lod = lod;
            rows.push_back({.lod = lod, .limit = limit, .plan = planFrame(frame.world, view, settings)});
        }
    for (int i = 0; i < runs; ++i)
        for (Row& row : rows) renderOnce(frame.world, row);

    fmt::print("{:<12} {:>10} {:>10} {:>7} {:>10} {:>7} {:>14} {:>8} {:>8}\n", "levels", "limit, px", "frame, ms",
               "ratio", "CPU, ms", "ratio", "triangles, M", "work", "most");
    for (std::size_t i = 0; i < rows.size(); ++i)
        print(frame, rows[i], rows[i / figure.limits.size() * figure.limits.size()]);
}

void measureStochastic(const Figure& figure) {
    Request options;
    options.scene = std::string(DEFOCUS_SOURCE_DIR "/") + figure.scene;
    options.size.width = 192;
    options.size.height = 144;
    options.time = figure.time;
    options.shutter = figure.shutter;
    options.samples = 16;
    options.lod = LodMode::off;
    PreparedFrame frame = prepareFrame(options);
    fmt::print("\n{}, method stochastic, {} x {}, {} rays per pixel, fastest of {} interleaved runs\n\n", figure.scene,
               frame.view.width, frame.view.height, frame.settings.sampleCount, stochasticRuns);
    std::vector<Row> rows;
    // figure.limits are in px of an image 512 px wide; scale them to the width of this image.
    for (const double of512 : figure.limits) {
        const double limit = of512 * frame.view.width / 512;
        View view = frame.view;
        view.lens.foregroundLimit = limit;
        rows.push_back({.limit = limit, .plan = planFrame(frame.world, view, frame.settings)});
    }
    // Interpolate the circle of confusion (CoC) linearly in triangles, as preset munkberg2012 does. By default, the
    // method subdivides triangles in which the CoC isn't linear. These occur only if the foreground blur is limited, so
    // subdivision would slow only the frames with a limit.
    RendererOptions linear;
    linear.settings = {{"coc-interpolation", "linear"}};
    const auto renderer = methodNamed("stochastic").make(frame.world, linear);
    std::vector<double> tests(rows.size());
    for (int i = 0; i < stochasticRuns; ++i)
        for (std::size_t row = 0; row < rows.size(); ++row) {
            drawAllSamples(*renderer, rows[row].plan);
            rows[row].milliseconds = std::min(rows[row].milliseconds, renderer->stats().renderMilliseconds);
            for (const MethodFigure& each : renderer->stats().figures)
                if (each.name == "triangles tested per ray") tests[row] = each.value;
        }
    fmt::print("{:>10} {:>10} {:>7} {:>14} {:>7}\n", "limit, px", "frame, ms", "ratio", "tests per ray", "ratio");
    for (std::size_t row = 0; row < rows.size(); ++row)
        fmt::print("{:>10} {:>10.0f} {:>7.2f} {:>14.1f} {:>7.2f}\n",
                   std::isinf(rows[row].limit) ? "none" : fmt::format("{:.0f}", rows[row].limit),
                   rows[row].milliseconds, rows[0].milliseconds / rows[row].milliseconds, tests[row],
                   tests[0] / tests[row]);
}

int run(bool stochasticOnly) {
    const auto context = createHeadlessContext();
    fmt::print("{}, {}\n", context->device(), context->driver());
    const Figure thicket = {"meshes/thicket.gltf", 0, 0, {infinity, 64, 8, 0}};
    const Figure chess = {"meshes/chess.glb", 0.06, 1.0 / 50, {infinity, 8, 0}};
    for (const Figure& figure : {thicket, chess}) {
        if (!stochasticOnly) measure(figure);
        measureStochastic(figure);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return defocus::engine::runBench("defocus_foreground_bench", [&] {
        const std::string_view option = argc > 1 ? argv[1] : "";
        if (argc > 2 || (argc == 2 && option != "--stochastic"))
            defocus::engine::fail("usage: defocus_foreground_bench [--stochastic]");
        return run(option == "--stochastic");
    });
}
