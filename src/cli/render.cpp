// defocus render: a scene to images.

#include "cli/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "capture/partial.h"
#include "cli/command.h"
#include "cli/image_output.h"
#include "cli/option_text.h"
#include "cli/render_tiles.h"
#include "cli/stop_signal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "frame/exposure.h"
#include "frame/memory_budget.h"
#include "frame/picture_warnings.h"
#include "frame/plan_warnings.h"
#include "frame/prepared_frame.h"
#include "frame/program_facts.h"
#include "frame/render_report.h"
#include "frame/tiled_frame.h"
#include "frame/unused_settings.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "image/tone_map.h"
#include "plan/swept_work.h"
#include "render/aov/aov.h"
#include "render/aov/work.h"
#include "render/frame_run.h"

namespace defocus {

namespace {

using Clock = std::chrono::steady_clock;

void parseAovs(const std::string& text, AovRequest& aovs) {
    const std::vector<std::string> names = {"depth", "coc", "level", "rate", "work", "swept-work"};
    const std::array<bool*, 6> wanted = {&aovs.depth, &aovs.coc, &aovs.level, &aovs.rate, &aovs.work, &aovs.sweptWork};
    for (const std::string& part : partsOf(text)) *wanted[parseChoice(part, names)] = true;
}

void addOutputs(CLI::App& command, RenderArguments& arguments) {
    const char* group = "Output";
    arguments.outputs = {"out.exr"};
    command
        .add_option(
            "-o,--output", arguments.outputs,
            fmt::format("Image to write: .exr is linear float with metadata, .png and .jpg are tone-mapped. {}. "
                        "Can be given several times",
                        standardOutputHelp))
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->default_str("out.exr")
        ->group(group);
    addParsed(
        command, "--aov", "depth,coc,level,rate,work,swept-work",
        "Also write, beside the first output, out.depth.exr (m), out.coc.exr (signed px), out.level.exr with "
        "out.level.png (level of detail), out.rate.exr with out.rate.png (images that method multirate draws of an "
        "object for a lens sample), out.work.exr with out.work.png (triangles that touch each pixel, "
        "summed over the lens samples of the accumulation, hidden ones too) and out.swept-work.exr with "
        "out.swept-work.png (triangles whose bounds over all of the lens cover each pixel: what a stochastic "
        "rasteriser tests there)",
        [&arguments](const std::string& text) { parseAovs(text, arguments.aovs); })
        ->group(group);
    addParsed(command, "--sample-range", "FIRST:END",
              "Sum up only these samples (multiples of 64) of the --samples, to an EXR file for 'defocus merge'",
              [&arguments](const std::string& text) { arguments.sampleRange = parseSampleRange(text); })
        ->group(group);
    addParsed(command, "--tile", "I/N",
              "Render part I (0 to N-1) of the image's rows, to an EXR file for 'defocus merge'",
              [&arguments](const std::string& text) { arguments.tile = parseTileShare(text); })
        ->group(group);
    command
        .add_flag(
            "--resume", arguments.resume,
            "Keep what an interrupted run of the same settings has finished: tiles of an image that doesn't fit into "
            "memory, which lie beside the first output in out.tiles, or the file of a --tile")
        ->group(group);
    addParsed(command, "--stats", "FILE",
              "Write times, triangles, memory and what was asked for as JSON; - is standard output",
              [&arguments](const std::string& text) { arguments.stats = text; })
        ->group(group);
}

// out.exr and "depth.exr" → out.depth.exr
std::filesystem::path derivedPath(const std::filesystem::path& output, const std::string& ending) {
    std::filesystem::path path = output;
    path.replace_extension(ending);
    return path;
}

std::vector<std::filesystem::path> aovPaths(const RenderArguments& arguments) {
    std::vector<std::filesystem::path> paths;
    const std::filesystem::path& output = arguments.outputs.front();
    if (arguments.aovs.depth) paths.push_back(derivedPath(output, "depth.exr"));
    if (arguments.aovs.coc) paths.push_back(derivedPath(output, "coc.exr"));
    if (arguments.aovs.level) paths.push_back(derivedPath(output, "level.exr"));
    if (arguments.aovs.level) paths.push_back(derivedPath(output, "level.png"));
    if (arguments.aovs.rate) paths.push_back(derivedPath(output, "rate.exr"));
    if (arguments.aovs.rate) paths.push_back(derivedPath(output, "rate.png"));
    if (arguments.aovs.work) paths.push_back(derivedPath(output, "work.exr"));
    if (arguments.aovs.work) paths.push_back(derivedPath(output, "work.png"));
    if (arguments.aovs.sweptWork) paths.push_back(derivedPath(output, "swept-work.exr"));
    if (arguments.aovs.sweptWork) paths.push_back(derivedPath(output, "swept-work.png"));
    return paths;
}

void checkOutputs(const RenderArguments& arguments) {
    std::vector<std::filesystem::path> more = aovPaths(arguments);
    if (!arguments.stats.empty()) more.push_back(arguments.stats);
    const Request& request = arguments.request;
    checkImageOutputs(arguments.outputs, more, {request.scene, request.environment, request.lens.apertureImage});
    if (arguments.aovs.any() && isStandardOutput(arguments.outputs.front()))
        fail("--aov writes files beside the first output, which must be a file");
    if (!arguments.sampleRange) return;
    if (arguments.request.stop.given())
        throw UsageError("--sample-range needs a number of samples, which --target-error and --time-limit leave open");
    if (arguments.request.settings.sampleCount == automaticSamples)
        throw UsageError("--sample-range is a part of a number of samples: give --samples N too");
    checkSampleRange(*arguments.sampleRange, arguments.request.settings.sampleCount);
    if (arguments.outputs.size() != 1 || arguments.outputs.front().extension() != ".exr" || arguments.aovs.any())
        fail("--sample-range writes the sums of samples to one EXR file, such as -o part.exr, and nothing else");
}

// Between two waves.
void stepOrStop(const Progress& progress, std::uint64_t samples, std::uint64_t total) {
    if (stopAsked()) fail("stopped after {} of {} samples: nothing is written", samples, total);
    report(progress, "samples", samples, total);
}

Image renderImage(FrameRun& run, Renderer& renderer, const RenderArguments& arguments, const PreparedFrame& frame,
                  const Progress& progress) {
    run.start(frame.view, runSettings(frame, arguments.request), arguments.request.stop);
    stopWhenAsked();
    do stepOrStop(progress, run.samples(), run.sampleTotal());
    while (run.advance());
    return renderer.image();
}

// Part of the samples: their sums, block by block, to one file.
void writeSums(const RenderArguments& arguments, FramePart part, const PreparedFrame& frame,
               const std::filesystem::path& shaderFolder, const Metadata& metadata) {
    part.settings = frameSettings(arguments, frame, shaderFolder);
    part.metadata = metadata;
    part.metadata["defocus:samples"] = static_cast<int>(part.frameSamples);
    writePart(arguments.outputs.front(), part);
}

void writeAovs(const RenderArguments& arguments, const AovImages& images, const Metadata& metadata) {
    const std::filesystem::path& output = arguments.outputs.front();
    if (arguments.aovs.depth) writeImage(derivedPath(output, "depth.exr"), images.depth, metadata);
    if (arguments.aovs.coc) writeImage(derivedPath(output, "coc.exr"), images.coc, metadata);
    if (arguments.aovs.level) {
        writeImage(derivedPath(output, "level.exr"), images.level, metadata);
        writeImage(derivedPath(output, "level.png"), levelColourMap(images.level));
    }
    if (!arguments.aovs.rate) return;
    writeImage(derivedPath(output, "rate.exr"), images.rate, metadata);
    writeImage(derivedPath(output, "rate.png"), rateColourMap(images.rate));
}

void writeWork(const RenderArguments& arguments, const FramePlan& plan, const Image& work, const Metadata& metadata,
               bool quiet) {
    const std::filesystem::path& output = arguments.outputs.front();
    const auto samples = static_cast<std::uint32_t>(plan.samples.size());
    writeImage(derivedPath(output, "work.exr"), work, metadata);
    writeImage(derivedPath(output, "work.png"), workColourMap(work, samples));
    const WorkSummary summary = workSummary(work, samples);
    if (!quiet)
        printMessage("work: {:.2f} triangles a pixel and lens sample, at most {:.1f}\n", summary.mean, summary.most);
}

void writeSweptWork(const RenderArguments& arguments, const Image& work, const Metadata& metadata, bool quiet) {
    const std::filesystem::path& output = arguments.outputs.front();
    writeImage(derivedPath(output, "swept-work.exr"), work, metadata);
    writeImage(derivedPath(output, "swept-work.png"), sweptWorkColourMap(work));
    const WorkSummary summary = workSummary(work, 1);
    if (!quiet) printMessage("swept work: {:.1f} triangles a pixel, at most {:.0f}\n", summary.mean, summary.most);
}

void printSummary(const RenderArguments& arguments, const RenderReport& report) {
    std::string names;
    for (const std::filesystem::path& path : arguments.outputs)
        names += (names.empty() ? "" : ", ") + shownOutput(path);
    for (const std::filesystem::path& path : aovPaths(arguments)) names += ", " + path.string();
    printMessage("{}: {}\n", names, summary(report));
}

void printChoices(const GlContext* context, const FramePlan& plan, const RenderReport& report) {
    if (context != nullptr)
        for (const std::string& line : context->log()) printMessage("{}\n", line);
    printMessage("{} layers of {} at once\n", report.stats.wave, report.stats.layerFormat);
    for (const LeftOut& entry : plan.leftOut) printMessage("left out: {}: {}\n", entry.what, entry.reason);
    printMessage("load {:.0f} ms, pyramids {:.0f} ms, set-up {:.0f} ms, render {:.0f} ms\n",
                 report.frame.loadMilliseconds, report.frame.pyramidMilliseconds, report.stats.setupMilliseconds,
                 report.stats.renderMilliseconds);
}

void runRender(const RenderArguments& arguments, const GlobalOptions& global) {
    // Faults first: method, outputs, scene, lens, device; only then the long work.
    const Clock::time_point start = Clock::now();
    const MethodUse use = chosenMethod(arguments.request);
    const Method& method = *use.method;
    checkStop(arguments.request);
    checkOutputs(arguments);
    checkTileOptions(arguments, method);
    Progress progress = terminalProgress(global);
    PreparedFrame frame = placeFrame(arguments.request, progress);
    std::unique_ptr<GlContext> context;
    if (method.needsGl || arguments.aovs.any()) context = createHeadlessContext();
    addPyramids(frame, progress);

    // What is worth knowing before the work; where it decides how many samples there are, the rest comes after it.
    progress = {};
    printFrameWarnings(frame, global);
    printWarnings(ignoredWarnings(*frame.scene), global);
    printWarnings(unusedSettings(arguments.request, *frame.scene, frame.view.lens), global);
    const auto warnOfPlan = [&](const FramePlan& plan, std::uint64_t samples = 0) {
        printWarnings(planWarnings(plan, use, samples), global);
    };
    const bool counted = !arguments.request.stop.given() && !isAutomatic(arguments.request);
    if (counted) warnOfPlan(planFrame(frame.world, frame.view, frame.settings));
    progress = terminalProgress(global);

    // Plan and render.
    const std::uint64_t limit = memoryLimit(arguments.request);
    const bool inTiles = drawsInTiles(arguments, frame, method, limit);
    RendererOptions options;
    options.layerFormat = arguments.request.layerFormat;
    options.wave = arguments.request.wave;
    options.waveBytes = waveBytesWithin(limit);
    if (method.needsGl && arguments.request.memory)
        options.wave = waveWithin(
            needsBeforeUpload(frame.world, planOfTiles(frame.world, frame.view, runSettings(frame, arguments.request)),
                              arguments.request, limit));
    options.shaderFolder = global.shaderDir;
    options.settings = use.settings;
    const std::unique_ptr<Renderer> renderer = method.make(frame.world, options);
    FrameRun run(frame.world, *renderer);
    FramePlan plan;
    Image image;
    FramePart part;
    std::optional<TiledFrame> tiled;
    const auto metadataOf = [&](const FramePlan& drawn, const RenderStats& drawnStats) {
        return renderMetadata({arguments.request, use.text(), frame, drawn, drawnStats});
    };
    if (inTiles) {
        tiled = renderTiles(arguments, frame, *renderer, limit, frameSettings(arguments, frame, global.shaderDir),
                            metadataOf, progress);
        plan = tiled->plan;
    } else if (arguments.sampleRange) {
        plan = planFrame(frame.world, frame.view, frame.settings);
        stopWhenAsked();
        part = renderPart(*renderer, plan, *arguments.sampleRange,
                          [&] { stepOrStop(progress, renderer->samples(), renderer->sampleTotal()); });
    } else {
        image = renderImage(run, *renderer, arguments, frame, progress);
        plan = run.plan();
    }
    const RenderStats stats = tiled ? tiled->stats : arguments.sampleRange ? renderer->stats() : run.stats();
    progress = {};
    if (!counted) warnOfPlan(plan, stats.samples);
    if (tiled) printWarnings(tiledSamplesNote(plan, isAutomatic(arguments.request)), global);

    // Write.
    const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const bool software = context == nullptr || context->software();
    if (metersExposure(arguments.request, *frame.scene, frame.view.lens) && !context) context = createHeadlessContext();
    const double exposure =
        chosenExposure(arguments.request, frame.world, frame.view, frame.settings, global.shaderDir);
    const RenderReport report{.options = arguments.request,
                              .method = use.text(),
                              .frame = frame,
                              .plan = plan,
                              .stats = stats,
                              .softwareDriver = software,
                              .totalMilliseconds = milliseconds,
                              .exposure = exposure,
                              .command = commandLine(global.words),
                              .memoryLimit = limit,
                              .tiles = tiled ? tiled->tiles : 1};
    const Metadata metadata = renderMetadata(report);
    const auto hasCurve = [](const std::filesystem::path& path) {
        return !path.string().starts_with("exr:") && path.extension() != ".exr";
    };
    if (!image.empty() && std::ranges::any_of(arguments.outputs, hasCurve))
        printWarnings(clippingWarnings(image, {arguments.request.toneMap, exposure}), global);
    if (arguments.sampleRange)
        writeSums(arguments, std::move(part), frame, global.shaderDir, metadata);
    else if (tiled)
        joinRenderedTiles(arguments, metadata, {arguments.request.toneMap, exposure});
    else
        for (const std::filesystem::path& path : arguments.outputs)
            writeOutput(path, image, metadata, WriteOptions{arguments.request.toneMap, exposure});
    if (arguments.aovs.surfaces())
        writeAovs(arguments, renderAovs(frame.world, plan, global.shaderDir, use.sharesImages()), metadata);
    if (arguments.aovs.work)
        writeWork(arguments, plan, renderWork(frame.world, plan, global.shaderDir), metadata, global.quiet);
    if (arguments.aovs.sweptWork) writeSweptWork(arguments, sweptWork(plan, frame.world), metadata, global.quiet);
    if (!arguments.stats.empty()) writeOutput(arguments.stats, statsJson(report));
    if (global.verbose) printChoices(context.get(), plan, report);
    if (!global.quiet) printSummary(arguments, report);
    if (!global.quiet && tiled && tiled->rowsKept > 0)
        printMessage("{} of {} rows there before\n", tiled->rowsKept, plan.view.height);
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderArguments& arguments) {
    addOutputs(command, arguments);
    addSettings(command, arguments.request, settingsOf(pictureGroups));
    addMethodSettings(command, arguments.request);
    addDeveloperSettings(command, arguments.request);
}

void addRenderCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = program.add_subcommand("render", "Render a glTF scene with the depth of field of a real lens");
    addRenderOptions(*command, *arguments);
    command->footer(
        "Examples:\n"
        "  defocus render -o fish.exr -o fish.png\n"
        "  defocus render scene.glb -o out.exr --fstop 1.4 --focus-distance 2.5 --samples 256\n"
        "  defocus render scene.glb -o out.png --tonemap agx --focus-pixel 512,384 --blades 7 --aov depth,coc\n"
        "  defocus render scene.glb -o out.exr --target-error 0.003 --time-limit 600\n"
        "  defocus render scene.glb -o out.png --method circular --far-components 5");
    command->callback([arguments, &global] { runRender(*arguments, global); });
}

}  // namespace defocus
