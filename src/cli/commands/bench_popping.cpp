// defocus bench popping: measures the frame-to-frame change that levels of detail add.

#include <fmt/format.h>

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
#include "eval/popping/text.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "scene/animation.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

struct PoppingArguments {
    Request request = measuredRequest();
    PoppingOptions options;
    BenchOutput output;
};

void runPopping(const PoppingArguments& arguments, const GlobalOptions& global) {
    if (arguments.options.frames > arguments.options.pathFrames)
        fail("--frames {} exceeds the {} frames of the movement (--path-frames)", arguments.options.frames,
             arguments.options.pathFrames);
    const fs::path folder = openBenchOutput(arguments.output, {"popping.csv", "popping.json"});
    Progress progress = terminalProgress(global);
    PreparedFrame frame = placeFrame(arguments.request, progress);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    addPyramids(frame, progress);
    printCacheUse(frame, global);
    WarningPrinter(global).print(frameWarnings(frame));

    PoppingOptions options = arguments.options;
    options.plan = frame.settings;
    if (!frame.scene->clips.empty()) {
        options.movements.push_back(Movement::clip);
        if (!arguments.request.clip.empty()) options.clip = clipNamed(*frame.scene, arguments.request.clip);
    }
    options.renderer.layerFormat = arguments.request.layerFormat;
    options.renderer.shaderFolder = global.shaderDir;
    const BenchSubject subject = benchSubject(*context, global, frame, 0);
    fmt::print("{}, {} x {} px, {} of {} frames of each movement, on {}\n\n", subject.scene, subject.width,
               subject.height, options.frames, options.pathFrames, subject.device);

    std::vector<PoppingFrame> frames;
    std::vector<SampleStep> steps;
    // Called after each measurement, so that an interrupted run loses at most one.
    const auto write = [&] {
        std::fflush(stdout);
        if (folder.empty()) return;
        writeFile(folder / "popping.csv", poppingCsv(frames));
        writeFile(folder / "popping.json", poppingJson(frames, steps, subject, options));
    };
    PoppingVisitor visitor;
    visitor.firstFrames = [](std::span<const PoppingFrame> first) {
        fmt::print("{}\n", firstFramesLine(first));
        std::fflush(stdout);
    };
    visitor.frames = [&](std::span<const PoppingFrame> added) {
        if (frames.empty()) fmt::print("{}", poppingHeader());
        frames.insert(frames.end(), added.begin(), added.end());
        for (const PoppingRow& row : poppingRows(added)) fmt::print("{}", poppingLine(row));
        write();
    };
    visitor.sampleStep = [&](const SampleStep& step) {
        fmt::print("{}{}", steps.empty() ? "\n" : "", sampleStepLine(step));
        steps.push_back(step);
        write();
    };
    measurePopping(frame.world, frame.view, options, visitor, progress);
    fmt::print("{}", poppingSummary(poppingRows(frames)));
    drawReport(folder, arguments.output.report);
}

}  // namespace

void addPoppingCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<PoppingArguments>();
    arguments->request.size = {320, 240};
    CLI::App* command = bench.add_subcommand("popping",
                                             "Measure how much changes of the level of detail alter the image between "
                                             "frames of a focus pull, dolly, turntable and animation");
    // Leave out settings that the bench varies itself, and exposure, because images are compared at EV 0.
    addSettings(*command, arguments->request,
                settingsOf(frameGroups, {"samples", "positions", "quality", "targetError", "timeLimit", "lod", "method",
                                         "exposureTime", "iso"}));
    const char* group = "Measurement";
    PoppingOptions& options = arguments->options;
    addIntegers(*command, "--counts", options.sampleCounts, 1, 4096, "Numbers of lens samples to measure")
        ->group(group);
    addInteger(
        *command, "--frames", options.frames, 2, 10'000,
        "Number of consecutive frames to measure in each movement; the part with the most level changes is chosen")
        ->group(group);
    addInteger(*command, "--path-frames", options.pathFrames, 2, 100'000,
               "Number of frames of a complete movement; with more frames, there is less movement per frame. "
               "Movements: focus from the "
               "nearest to the farthest object, dolly over half the focus distance, one turn of the camera around the "
               "scene, one cycle of the animation")
        ->group(group);
    addBenchOutput(*command, arguments->output, "the results popping.csv and popping.json");
    addDeveloperSettings(*command, arguments->request,
                         {"keepAll", "memory", "wave", "threads"});  // these settings don't affect the results
    command->footer(
        "Examples:\n"
        "  defocus bench popping --fish 6 --fish-triangles 20000 -o popping\n"
        "  defocus bench popping scene.glb --counts 32 --frames 96 --path-frames 96");
    command->callback([arguments, &global] { runPopping(*arguments, global); });
}

}  // namespace defocus::engine
