// defocus bench prediction: compares the errors that a mesh pyramid predicts for its levels with rendered errors.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "cli/commands/bench_commands.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/file.h"
#include "eval/prediction/text.h"
#include "gl/context.h"

namespace defocus::engine {

namespace {

struct PredictionArguments {
    Request request = measuredRequest();
    PredictionOptions options;
    BenchOutput output;
};

void runPrediction(const PredictionArguments& arguments, const GlobalOptions& global) {
    const std::filesystem::path folder = openBenchOutput(arguments.output, {"prediction.csv", "prediction.json"});
    const Progress progress = terminalProgress(global);
    const PreparedFrame frame = placeFrame(arguments.request, progress);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    PredictionOptions options = arguments.options;
    options.width = arguments.request.size.width;
    options.height = arguments.request.size.height;
    options.renderer.shaderFolder = global.shaderDir;
    BenchSubject subject = benchSubject(*context, global);
    subject.scene = frame.sceneName;
    fmt::print(
        "{}, {} x {} px, on {}: errors in linear radiance, relative to its mean\n"
        "\n"
        "{}",
        frame.sceneName, options.width, options.height, subject.device, predictionHeader());
    std::fflush(stdout);
    std::vector<PredictionRow> rows;
    measurePrediction(
        frame, options,
        [&](const PredictionRow& row) {
            rows.push_back(row);
            fmt::print("{}", predictionLine(row));
            std::fflush(stdout);
            if (folder.empty()) return;
            writeFile(folder / "prediction.csv", predictionCsv(rows));
            writeFile(folder / "prediction.json", predictionJson(rows, subject));
        },
        progress);
    fmt::print("{}", predictionSummary(rows));
}

}  // namespace

void addPredictionCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<PredictionArguments>();
    arguments->request.size = {arguments->options.width, arguments->options.height};
    CLI::App* command = bench.add_subcommand(
        "prediction",
        "Compare the predicted error of each level of a scene's largest mesh with the error in a rendered image, for "
        "several blur diameters");
    addNumbers(*command, "--cocs", arguments->options.cocs, {0.01, 1e4}, "PX,PX,…",
               "Blur at the centre of the mesh, in px")
        ->group("Measurement");
    addSettings(*command, arguments->request, {"scene", "fishCount", "trianglesPerFish", "size"});
    addBenchOutput(*command, arguments->output, "the results prediction.csv and prediction.json", false);
    command->footer(
        "Examples:\n"
        "  defocus bench prediction\n"
        "  defocus bench prediction scene.glb --cocs 2,8,32 -o prediction");
    command->callback([arguments, &global] { runPrediction(*arguments, global); });
}

}  // namespace defocus::engine
