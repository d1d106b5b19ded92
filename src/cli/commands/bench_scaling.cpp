// defocus bench scaling: measures how a frame's time and memory grow with its parameters.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "cli/commands/bench_commands.h"
#include "cli/commands/bench_report.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/file.h"
#include "eval/scaling/text.h"
#include "gl/context.h"
#include "lod/pyramid/cache.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

struct ScalingArguments {
    ScalingOptions options;
    Request request;      // only the request's cache folder is used
    bool scenes = false;  // true: also measure two large scenes
    BenchOutput output;
};

void runScaling(const ScalingArguments& arguments, const GlobalOptions& global) {
    if (arguments.options.large &&
        std::ranges::find(arguments.options.axes, ScalingAxis::triangles) == arguments.options.axes.end())
        throw UsageError("--large extends the axis 'triangles'; add 'triangles' to --axes");
    const fs::path folder = openBenchOutput(arguments.output, {"scaling.csv", "scaling.json"});
    const Progress progress = terminalProgress(global);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    ScalingOptions options = arguments.options;
    options.cacheFolder = arguments.request.cacheFolder.empty() ? defaultCacheFolder() : arguments.request.cacheFolder;
    options.renderer.shaderFolder = global.shaderDir;
    BenchSubject subject = benchSubject(*context, global);
    subject.runs = options.runs;
    fmt::print("{} runs each, on {}\n\n{}", subject.runs, subject.device, scalingHeader());
    std::fflush(stdout);

    // Write all rows after each new row, so that an interrupted run loses nothing.
    std::vector<ScalingRow> rows;
    std::vector<ScalingLeftOut> leftOut;
    std::vector<LargeSceneRow> scenes;
    const auto write = [&] {
        std::fflush(stdout);
        if (folder.empty()) return;
        writeFile(folder / "scaling.csv", scalingCsv(rows));
        writeFile(folder / "scaling.json", scalingJson(rows, leftOut, scenes, subject));
    };
    const ScalingVisitor visitor = {[&](const ScalingRow& row) {
                                        rows.push_back(row);
                                        fmt::print("{}", scalingLine(row));
                                        write();
                                    },
                                    [&](const ScalingPoint& point, const std::string& reason) {
                                        leftOut.push_back({point, reason});
                                        fmt::print("{}", scalingLine(leftOut.back()));
                                        write();
                                    }};
    measureScaling(options, visitor, progress);
    fmt::print("{}", scalingSummary(rows));
    if (arguments.scenes) fmt::print("{}", largeSceneHeader());
    for (const LargeScene& scene : arguments.scenes ? largeScenes() : std::vector<LargeScene>()) {
        scenes.push_back(measureLargeScene(scene, {options.runs, options.cacheFolder, options.renderer}, progress));
        fmt::print("{}", largeSceneLine(scenes.back()));
        write();
    }
    drawReport(folder, arguments.output.report);
}

}  // namespace

void addScalingCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<ScalingArguments>();
    CLI::App* command = bench.add_subcommand(
        "scaling",
        "Measure how time and memory grow with triangles, instances, samples, pixels and blur, and fit "
        "power laws");
    const char* group = "Measurement";
    ScalingOptions& options = arguments->options;
    const std::vector<ScalingAxis> all = options.axes;
    std::vector<std::string> names;
    for (const ScalingAxis axis : all) names.emplace_back(scalingAxisName(axis));
    addList(*command, "--axes", "AXIS,AXIS,…", options.axes,
            "Quantities to vary: triangles, instances, samples, pixels, blur",
            [all, names](const std::string& part) { return all[parseChoice(part, names)]; })
        ->default_str(fmt::format("{}", fmt::join(names, ",")))
        ->group(group);
    command
        ->add_flag("--large", options.large,
                   "Measure up to 50 million triangles instead of 10 million, as far as memory allows; building their "
                   "pyramids takes minutes")
        ->group(group);
    command
        ->add_flag("--scenes", arguments->scenes,
                   "Also measure two large scenes (one with 100 million instanced triangles, one with 10,000 different "
                   "objects): planning time, memory and time to the first image; building their pyramids takes minutes")
        ->group(group);
    addInteger(*command, "--runs", options.runs, 1, 1000, "Number of runs of each frame; the median is reported")
        ->group(group);
    addSettings(*command, arguments->request, {"cacheFolder"});
    addBenchOutput(*command, arguments->output, "the results scaling.csv and scaling.json");
    command->footer(
        "Examples:\n"
        "  defocus bench scaling -o scaling\n"
        "  defocus bench scaling --axes triangles --large");
    command->callback([arguments, &global] { runScaling(*arguments, global); });
}

}  // namespace defocus::engine
