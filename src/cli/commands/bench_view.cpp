// defocus bench view: measures the window's frame rate, response and image error without a display.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/commands/bench_commands.h"
#include "cli/options/method_list.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/file.h"
#include "frame/report/json_values.h"
#include "gl/context.h"
#include "view/bench/refocus_bench.h"
#include "view/bench/view_bench.h"

namespace defocus::engine {

namespace {

struct ViewBenchArguments {
    Request request = measuredRequest();
    ViewBenchOptions options;
    bool refocus = false;  // true: measure the response to changes of focus and f-number, not to camera movement
    BenchOutput output;
};

std::string seconds(double value) {
    return std::isfinite(value) ? fmt::format("{:.2f}", value) : "-";
}

std::string headerText() {
    return fmt::format(
        "{:24} {:>8} {:>8} {:>8} {:>10} {:>8} {:>8}   {:>8} {:>8} {:>8} {:>8}\n{:24} {:>8} {:>8} {:>8} "
        "{:>10} {:>8} {:>8}   {:>8} {:>8} {:>8} {:>8}\n",
        "moving, then at rest", "frames", "slow", "first", "size", "lens", "PSNR", "first", "conver-", "lens", "PSNR",
        "method", "/s", "ms", "ms", "", "samples", "dB", "still, s", "ged, s", "samples", "dB");
}

std::string lineText(const ViewBenchRow& row) {
    return fmt::format("{:24} {:8.1f} {:8.1f} {:8.1f} {:>10} {:8} {:8.1f}   {:>8} {:>8} {:8} {:8.1f}\n", row.method,
                       row.framesPerSecond, row.slowFrame, row.firstPicture,
                       fmt::format("{:.0f} %", 100 * row.quality.resolution), row.quality.samples, row.movingPsnr,
                       seconds(row.stillPicture), seconds(row.converged), row.samples, row.stillPsnr);
}

nlohmann::ordered_json rowJson(const ViewBenchRow& row) {
    return {{"method", row.method},
            {"framesPerSecond", row.framesPerSecond},
            {"slowFrameMilliseconds", row.slowFrame},
            {"firstPictureMilliseconds", row.firstPicture},
            {"movingResolution", row.quality.resolution},
            {"movingSamples", row.quality.samples},
            {"movingPsnr", jsonNumber(row.movingPsnr)},
            {"stillPictureSeconds", jsonNumber(row.stillPicture)},
            {"convergedSeconds", jsonNumber(row.converged)},
            {"stillSamples", row.samples},
            {"stillPsnr", jsonNumber(row.stillPsnr)}};
}

std::string refocusHeaderText() {
    return fmt::format(
        "{:24} {:12} {:>8}   {:>8} {:>8} {:>8} {:>8}   {:>9} {:>8} {:>8}\n{:24} {:12} {:>8}   {:>8} {:>8} {:>8} {:>8}  "
        " "
        "{:>9} {:>8} {:>8}\n",
        "dragged at rest", "method", "kept", "frame", "size", "lens", "PSNR", "full qua-", "lens", "PSNR", "", "",
        "images", "ms", "", "samples", "dB", "lity, ms", "samples", "dB");
}

std::string refocusLineText(const RefocusBenchRow& row) {
    return fmt::format("{:24} {:12} {:8}   {:8.1f} {:>8} {:8} {:8.1f}   {:9.1f} {:8} {:8.1f}\n", row.change, row.method,
                       row.keptImages, row.dragMilliseconds, fmt::format("{:.0f} %", 100 * row.dragQuality.resolution),
                       row.dragQuality.samples, row.dragPsnr, row.fullMilliseconds, row.fullSamples, row.fullPsnr);
}

nlohmann::ordered_json refocusRowJson(const RefocusBenchRow& row) {
    return {{"change", row.change},
            {"method", row.method},
            {"keptImages", row.keptImages},
            {"dragMilliseconds", row.dragMilliseconds},
            {"dragResolution", row.dragQuality.resolution},
            {"dragSamples", row.dragQuality.samples},
            {"dragPsnr", jsonNumber(row.dragPsnr)},
            {"fullMilliseconds", row.fullMilliseconds},
            {"fullSamples", row.fullSamples},
            {"fullPsnr", jsonNumber(row.fullPsnr)}};
}

void runViewBench(const ViewBenchArguments& arguments, const GlobalOptions& global) {
    const std::filesystem::path folder = openBenchOutput(arguments.output, {"view.json"});
    const Progress progress = terminalProgress(global);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    ViewBenchOptions options = arguments.options;
    options.shaderFolder = global.shaderDir;
    options.software = context->software();
    if (options.methods.empty()) options.methods = parseMethods("auto,accumulation,multirate");

    Document document;
    document.shaderFolder = global.shaderDir;
    ViewState state;
    state.options = arguments.request;
    state.pictureSize = {arguments.request.size.width, arguments.request.size.height};
    state.area.size = state.pictureSize;
    openForBench(document, state);
    const BenchSubject subject = benchSubject(*context, global, *document.frame, 1);
    fmt::print("{}, {} x {} px, {}, on {}\n\n{}", subject.scene, subject.width, subject.height,
               arguments.refocus ? "changes of focus and f-number with a still camera"
                                 : fmt::format("an orbit of {} frames", options.frames),
               subject.device, arguments.refocus ? refocusHeaderText() : headerText());
    std::fflush(stdout);
    nlohmann::ordered_json json = subjectJson("view", subject);
    json["heldEqual"] =
        "scene, camera path, lens, image size, reference, process; the methods are measured one after "
        "another";
    json["referenceSamples"] = options.referenceSamples;
    const auto take = [&](const std::string& line, const nlohmann::ordered_json& row) {
        fmt::print("{}", line);
        std::fflush(stdout);
        json["rows"].push_back(row);
        if (!folder.empty()) writeFile(folder / "view.json", documentText(json));
    };
    if (arguments.refocus) {
        measureRefocus(
            document, state, options,
            [&](const RefocusBenchRow& row) { take(refocusLineText(row), refocusRowJson(row)); }, progress);
        return;
    }
    json["frames"] = options.frames;
    measureView(
        document, state, options, [&](const ViewBenchRow& row) { take(lineText(row), rowJson(row)); }, progress);
}

}  // namespace

void addBenchViewCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<ViewBenchArguments>();
    arguments->request.size = {1280, 720};
    CLI::App* command = bench.add_subcommand(
        "view", "Measure the frame rate, response time and image error of the viewer, without a display");
    const char* group = "Measurement";
    ViewBenchOptions& options = arguments->options;
    addParsed(*command, "--methods", "NAME,NAME,…",
              "Methods to measure, with their settings. Default: auto,accumulation,multirate",
              [&options](const std::string& text) { options.methods = parseMethods(text); })
        ->group(group);
    addInteger(*command, "--frames", options.frames, 4, 10'000, "Frames of the camera's orbit, 1 degree each")
        ->group(group);
    addNumber(*command, "--rest", options.restSeconds, {0.1, 3600}, "S",
              "Maximum time in s to wait for the image to converge after the orbit")
        ->group(group);
    addInteger(*command, "--reference-samples", options.referenceSamples, 2, maxSamples,
               "Lens samples of the references at full detail")
        ->group(group);
    command
        ->add_flag("--refocus", arguments->refocus,
                   "Instead of orbiting, keep the camera still and measure the frames while focus and f-number change, "
                   "with and without stored lens images")
        ->group(group);
    addSettings(*command, arguments->request,
                settingsOf(frameGroups, {"samples", "quality", "timeLimit", "method", "exposureTime", "iso"}));
    addBenchOutput(*command, arguments->output, "the result view.json", false);
    addDeveloperSettings(*command, arguments->request, {"keepAll", "memory", "threads"});
    command->footer(
        "Examples:\n"
        "  defocus bench view\n"
        "  defocus bench view scene.glb --methods accumulation,circular --frames 120 -o view\n"
        "  defocus bench view --refocus --methods auto");
    command->callback([arguments, &global] {
        arguments->options.convergedError = arguments->request.targetError.value_or(arguments->options.convergedError);
        runViewBench(*arguments, global);
    });
}

}  // namespace defocus::engine
