// defocus bench: measures speed and image error on this machine.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "cli/command.h"
#include "cli/commands/bench_commands.h"
#include "cli/commands/bench_report.h"
#include "cli/options/method_list.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/file.h"
#include "eval/speedup/text.h"
#include "frame/program_facts.h"
#include "frame/settings/presets.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"

namespace defocus::engine {

namespace {

struct SpeedupArguments {
    Request request = measuredRequest();
    std::string preset;  // name of the given preset; empty: none
    SpeedupOptions speedup;
    BenchOutput output;
};

SpeedupForm formOf(const PreparedFrame& frame, const std::string& preset) {
    return {preset, &frame.world, frame.settings, frame.pyramidMilliseconds};
}

void runSpeedup(const SpeedupArguments& arguments, const GlobalOptions& global) {
    const std::filesystem::path folder = openBenchOutput(arguments.output, {"speedup.csv", "speedup.json"});
    Progress progress = terminalProgress(global);
    Request scene = arguments.request;
    scene.noCache = true;  // build all pyramids, because the results include their build time
    PreparedFrame frame = placeFrame(scene, progress);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    addPyramids(frame, progress);
    std::vector<SpeedupForm> forms = {formOf(frame, arguments.preset)};
    PreparedFrame plain;  // the same scene without the preset, for comparison
    if (!arguments.preset.empty()) {
        clearPreset(presetNamed(arguments.preset), scene);
        plain = placeFrame(frame.scene, scene, &frame.world.environment);
        addPyramids(plain, progress);
        forms.push_back(formOf(plain, ""));
    }

    SpeedupOptions options = arguments.speedup;
    options.renderer.layerFormat = arguments.request.layerFormat;
    options.renderer.wave = arguments.request.wave.value_or(0);
    options.renderer.shaderFolder = global.shaderDir;
    const BenchSubject subject = benchSubject(*context, global, frame, options.runs);
    fmt::print("{}, {} x {} px, {} runs each, on {}\n\n{}", subject.scene, subject.width, subject.height, subject.runs,
               subject.device, speedupHeader());

    // Write all rows after each new row, so that an interrupted run loses nothing.
    std::vector<SpeedupRow> rows;
    measureSpeedup(
        forms, frame.view, options,
        [&](const SpeedupRow& row) {
            rows.push_back(row);
            fmt::print("{}", speedupLine(row));
            std::fflush(stdout);
            if (folder.empty()) return;
            writeFile(folder / "speedup.csv", speedupCsv(rows));
            writeFile(folder / "speedup.json", speedupJson(rows, subject));
        },
        progress);
    drawReport(folder, arguments.output.report);
}

void addSpeedup(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<SpeedupArguments>();
    CLI::App* command = bench.add_subcommand("speedup",
                                             "Compare frame time and image error of full detail, nearest levels and "
                                             "fractional levels of detail, from a fixed camera");
    const char* group = "Measurement";
    SpeedupOptions& options = arguments->speedup;
    addIntegers(*command, "--counts", options.sampleCounts, 1, maxSamples, "Numbers of lens samples to measure")
        ->group(group);
    addNumbers(*command, "--fstops", options.fStops, {0.001, 1e6}, "N,N,…",
               "Additional f-numbers to measure, at 64 samples")
        ->group(group);
    addNumbers(*command, "--focus-distances", options.focusDistances, {1e-6, 1e12}, "M,M,…",
               "Additional focus distances in m to measure, at 64 samples")
        ->group(group);
    addParsed(*command, "--methods", "NAME,NAME,…",
              "Additional methods to measure, with their settings, such as scheuermann,circular:far-components=2",
              [&options](const std::string& text) { options.methods = parseMethods(text); })
        ->group(group);
    addInteger(*command, "--runs", options.runs, 1, 1000, "Number of runs of each mode; the median is reported")
        ->group(group);
    addInteger(*command, "--seeds", options.seeds, 1, 1000,
               "Number of seeds, used in turn by the runs to measure the spread of errors; at most the number of runs")
        ->group(group);
    addParsed(*command, "--reference-samples", "N",
              "Number of lens samples of the reference; 0: no reference. Default: eight times the largest number of "
              "samples measured with the same lens",
              [&options](const std::string& text) {
                  options.referenceSamples = static_cast<std::uint32_t>(parseInteger(text, 0, maxSamples));
              })
        ->group(group);
    addBenchOutput(*command, arguments->output, "the results speedup.csv and speedup.json");
    // Leave out the settings that the bench varies itself. Also leave out the cache, because the results include the
    // pyramids' build time, and exposure, because images are compared at EV 0.
    addSettings(*command, arguments->request,
                settingsOf(frameGroups, {"samples", "positions", "quality", "targetError", "timeLimit", "lod", "method",
                                         "cacheFolder", "noCache", "exposureTime", "iso"}));
    addDeveloperSettings(*command, arguments->request, {"memory", "threads"});
    command->footer(
        "Examples:\n"
        "  defocus bench speedup --counts 16,64 -o bench-fish\n"
        "  defocus bench speedup scene.glb --fstops 1.4,2.8,5.6 --reference-samples 1024\n"
        "  defocus bench speedup --preset jeong2011 --report figure-2\n"
        "With --preset, everything is measured twice: with and without the preset.");
    command->callback([arguments, command, &global] {
        const CLI::Option& preset = *command->get_option("--preset");
        if (!preset.empty()) arguments->preset = preset.results().front();
        runSpeedup(*arguments, global);
    });
}

}  // namespace

Request measuredRequest() {
    Request request;
    request.units = 1;
    return request;
}

void addBenchOutput(CLI::App& command, BenchOutput& output, const std::string& results, bool hasReport) {
    CLI::Option* folder =
        command.add_option("-o,--output", output.folder, "Folder for " + results)->type_name("FOLDER")->group("Output");
    if (hasReport) addReport(command, folder, output.report);
    addAllowChanged(command, output.allowChanged);
}

std::filesystem::path openBenchOutput(const BenchOutput& output, std::initializer_list<const char*> files) {
    const std::filesystem::path& folder = output.report.empty() ? output.folder : output.report;
    refuseChangedSources(folder, output.allowChanged);
    makeOutputFolder(folder, files);
    return folder;
}

void makeOutputFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files) {
    if (folder.empty()) return;
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    if (fault) fail("cannot create the folder {}: {}", folder.string(), fault.message());
    for (const char* name : files) checkWritable(folder / name);
}

void addAllowChanged(CLI::App& command, bool& allowed) {
    advanced(command
                 .add_flag("--allow-changed", allowed,
                           "Write results even if the program was built from uncommitted sources")
                 ->group("Output"));
}

void refuseChangedSources(const std::filesystem::path& output, bool allowed, const std::string& commit) {
    if (output.empty() || allowed || !commit.ends_with("-changed")) return;
    fail(
        "{}: results are not written because the program was built from uncommitted sources ({}); commit and rebuild, "
        "or pass --allow-changed",
        output.string(), commit);
}

BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global) {
    BenchSubject subject;
    subject.program = "defocus " + programVersion();
    subject.commit = programCommit();
    subject.commands = {commandLine(global.words)};
    subject.machine = thisMachine();
    subject.device = context.device();
    subject.driver = context.driver();
    subject.software = context.software();
    return subject;
}

BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global, const PreparedFrame& frame, int runs) {
    BenchSubject subject = benchSubject(context, global);
    subject.scene = frame.sceneName;
    subject.camera = frame.cameraName;
    subject.lens = frame.view.lens;
    subject.width = frame.view.width;
    subject.height = frame.view.height;
    subject.runs = runs;
    subject.pyramidMilliseconds = frame.pyramidMilliseconds;
    return subject;
}

void addBenchCommand(CLI::App& program, const GlobalOptions& global) {
    CLI::App* bench = program.add_subcommand("bench", "Measure render time and image error on this machine");
    bench->require_subcommand(1);
    addSpeedup(*bench, global);
    addConvergenceCommand(*bench, global);
    addStabilityCommand(*bench, global);
    addPoppingCommand(*bench, global);
    addScalingCommand(*bench, global);
    addPredictionCommand(*bench, global);
    addBenchViewCommand(*bench, global);
}

}  // namespace defocus::engine
