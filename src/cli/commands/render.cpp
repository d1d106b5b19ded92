// defocus render: renders a scene to images.

#include "cli/commands/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/commands/lens_images.h"
#include "cli/options/image_output.h"
#include "cli/options/option_text.h"
#include "cli/terminal/stop_signal.h"
#include "core/error.h"
#include "core/message.h"
#include "core/stopwatch.h"
#include "frame/driver/frame_output.h"
#include "frame/program_facts.h"
#include "frame/report/layer_file.h"
#include "frame/report/picture_warnings.h"
#include "image/image_io.h"
#include "render/aov/work.h"

namespace defocus::engine {

namespace {

void parseAovs(const std::string& text, AovRequest& aovs) {
    const std::vector<std::string> names = {"depth", "coc", "level", "work"};
    const std::array<bool*, 4> wanted = {&aovs.depth, &aovs.coc, &aovs.level, &aovs.work};
    for (const std::string& part : splitAt(text, ',')) *wanted[parseChoice(part, names)] = true;
}

void addOutputs(CLI::App& command, RenderArguments& arguments) {
    const char* group = "Output";
    arguments.outputs = {"out.exr"};
    addImageOutputs(command, arguments.outputs)->group(group);
    advanced(
        addParsed(
            command, "--aov", "depth,coc,level,work",
            "Also write auxiliary images beside the first output. depth: depth in m. coc: signed circle of confusion "
            "in px. level: level of detail. work: triangles per pixel, including hidden triangles, summed over the "
            "lens samples that method accumulation draws. depth and coc are written as EXR, level and work as EXR and "
            "PNG",
            [&arguments](const std::string& text) { parseAovs(text, arguments.aovs); })
            ->group(group));
    advanced(addParsed(command, "--sample-range", "FIRST:END",
                       "Draw only lens samples FIRST to END-1, to an EXR file that 'defocus merge' combines with the "
                       "other parts. FIRST and END are multiples of 64; END can also be the number of samples",
                       [&arguments](const std::string& text) { arguments.sampleRange = parseSampleRange(text); })
                 ->group(group));
    advanced(addParsed(command, "--tile", "I/N",
                       "Divide the image into N horizontal tiles and render only tile I (0 to N-1), to an EXR file for "
                       "'defocus merge'",
                       [&arguments](const std::string& text) { arguments.tile = parseTileShare(text); })
                 ->group(group));
    command
        .add_flag("--resume", arguments.resume,
                  "Continue an interrupted run with the same settings. Finished tiles are read from the folder "
                  "NAME.tiles beside the first output NAME.exr. With --tile, a finished output file is kept")
        ->group(group);
    advanced(command
                 .add_flag("--keep-partial", arguments.keepPartial,
                           "On Ctrl-C or SIGTERM, finish the current lens sample and write the image of the samples so "
                           "far; the exit code is 1. A second signal ends the program at once")
                 ->group(group));
    advanced(addParsed(command, "--lens-images", "FILE.exr",
                       "Write the image of each lens sample to a multi-part EXR file. With 'defocus refocus', focus, "
                       "f-number and bokeh can then be changed after rendering. Replaces --output",
                       [&arguments](const std::string& text) { arguments.lensImages = text; })
                 ->excludes("--output")
                 ->excludes("--aov")
                 ->excludes("--sample-range")
                 ->excludes("--tile")
                 ->excludes("--resume")
                 ->group(group));
    advanced(addParsed(command, "--focus-range", "NEAR:FAR",
                       "Range of focus distances in m that 'defocus refocus' can choose from; FAR may be inf. Default: "
                       "from the nearest to the farthest visible surface",
                       [&arguments](const std::string& text) { arguments.focusRange = parseFocusRange(text); })
                 ->needs("--lens-images")
                 ->group(group));
    advanced(addParsed(command, "--stats", "FILE",
                       "Write render times, triangle counts, memory use and the requested settings as JSON; - writes "
                       "to standard output",
                       [&arguments](const std::string& text) { arguments.stats = text; })
                 ->group(group));
}

// Inserts `ending` before the extension: out.exr and "depth.exr" give out.depth.exr.
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
    if (arguments.aovs.work) paths.push_back(derivedPath(output, "work.exr"));
    if (arguments.aovs.work) paths.push_back(derivedPath(output, "work.png"));
    return paths;
}

FrameFiles filesOf(const RenderArguments& arguments) {
    FrameFiles files{arguments.outputs,    arguments.sampleRange, arguments.tile, arguments.resume, {},
                     arguments.keepPartial};
    if (arguments.aovs.any())
        files.untiledReason = "--aov needs the whole image";
    else if (std::ranges::any_of(arguments.outputs, isStandardOutput))
        files.untiledReason = "standard output needs the whole image";
    return files;
}

void checkOutputs(const RenderArguments& arguments) {
    std::vector<std::filesystem::path> more = aovPaths(arguments);
    if (!arguments.stats.empty()) more.push_back(arguments.stats);
    const Request& request = arguments.request;
    checkImageOutputs(arguments.outputs, more, {request.scene, request.environment, request.lens.apertureImage});
    if (arguments.aovs.any() && isStandardOutput(arguments.outputs.front()))
        fail("--aov writes files beside the first output; give a file as the first output");
    if (!request.layers.empty()) {
        if (std::ranges::none_of(arguments.outputs, isExr)) fail("--exr-layers needs an .exr file as an output");
        if (arguments.keepPartial) fail("--keep-partial keeps only the image, without layers; leave out --exr-layers");
    }
    FrameOutput::check(filesOf(arguments), request);
}

void writeAovs(const RenderArguments& arguments, const AovImages& images, const Metadata& metadata) {
    const std::filesystem::path& output = arguments.outputs.front();
    if (arguments.aovs.depth) writeImage(derivedPath(output, "depth.exr"), images.depth, metadata);
    if (arguments.aovs.coc) writeImage(derivedPath(output, "coc.exr"), images.coc, metadata);
    if (!arguments.aovs.level) return;
    writeImage(derivedPath(output, "level.exr"), images.level, metadata);
    writeImage(derivedPath(output, "level.png"), levelColourMap(images.level));
}

void writeWork(const RenderArguments& arguments, const FramePlan& plan, const Image& work, const Metadata& metadata,
               bool quiet) {
    const std::filesystem::path& output = arguments.outputs.front();
    const auto samples = static_cast<std::uint32_t>(plan.samples.size());
    writeImage(derivedPath(output, "work.exr"), work, metadata);
    writeImage(derivedPath(output, "work.png"), workColourMap(work, samples));
    const WorkSummary summary = workSummary(work, samples);
    if (!quiet)
        printMessage("work: {:.2f} triangles per pixel and lens sample, maximum {:.1f}\n", summary.mean, summary.max);
}

void printSummary(const RenderArguments& arguments, const RenderReport& report, int rowsKept) {
    std::string names = shownOutputs(arguments.outputs);
    for (const std::filesystem::path& path : aovPaths(arguments)) names += ", " + path.string();
    printMessage("{}: {}\n", names, summary(report));
    if (rowsKept > 0) printMessage("{} of {} rows kept from earlier runs\n", rowsKept, report.plan.view.height);
}

void printChoices(const GlContext& context, const RenderReport& report) {
    for (const std::string& line : context.log()) printMessage("{}\n", line);
    printMessage("{} drawn at once, pixel format {}\n", imageCount(report, report.stats.wave),
                 report.stats.layerFormat);
    for (const LeftOut& entry : report.plan.leftOut) printMessage("left out: {}: {}\n", entry.what, entry.reason);
    printMessage("load {:.0f} ms, pyramids {:.0f} ms, set-up {:.0f} ms, render {:.0f} ms\n",
                 report.frame.loadMilliseconds, report.frame.pyramidMilliseconds, report.stats.setupMilliseconds,
                 report.stats.renderMilliseconds);
}

// Image of the samples drawn so far, with all data that is needed to write it to a file.
struct PartialImage {
    Image image;
    WriteOptions options;
    Metadata metadata;
    std::uint32_t samples = 0;
    std::uint32_t sampleTotal = 0;
};

// Returns the image of the samples drawn so far; nullopt if there is none to keep (see FrameOutput::partialImage).
std::optional<PartialImage> partialImage(FrameOutput& output, SceneDriver& driver) {
    std::optional<Image> image = output.partialImage();
    if (!image) return {};
    const FrameDriver& frame = driver.driver();
    return PartialImage{std::move(*image), driver.writeOptions(), driver.metadata(), frame.samples(),
                        frame.sampleTotal()};
}

// Writes the image of an interrupted render. Returns a message for the user with the number of samples drawn.
std::string writePartial(const std::vector<std::filesystem::path>& outputs, const PartialImage& partial) {
    for (const std::filesystem::path& path : outputs)
        writeOutput(path, partial.image, partial.metadata, partial.options);
    return fmt::format("stopped after {} of {} samples: the image from these samples was written", partial.samples,
                       partial.sampleTotal);
}

// Keeps a copy of the unfinished image, which is written if a signal arrives during a long draw. The copy is renewed at
// most twice a second, because reading an image takes time. Between short draws, the main thread handles the signal
// itself.
class PartialCopies {
public:
    PartialCopies(FrameOutput& output, SceneDriver& driver, const std::vector<std::filesystem::path>& outputs)
        : output_(output), driver_(driver), outputs_(outputs) {}

    void renew() {
        if (samples_ == driver_.driver().samples() || (samples_ > 0 && millisecondsSince(copied_) < 500)) return;
        std::optional<PartialImage> partial = partialImage(output_, driver_);
        if (!partial) return;
        samples_ = partial->samples;
        copied_ = Clock::now();
        const auto copy = std::make_shared<const PartialImage>(std::move(*partial));
        setStopAction([copy, outputs = outputs_] { return writePartial(outputs, *copy); });
    }

private:
    FrameOutput& output_;
    SceneDriver& driver_;
    const std::vector<std::filesystem::path>& outputs_;
    std::uint32_t samples_ = 0;  // number of samples in the latest copy of the image
    Clock::time_point copied_;
};

// Draws the frame. Finished rows of a tiled frame are written to disk at once. Returns false if a signal stops drawing.
bool draw(FrameOutput& output, SceneDriver& driver, const Progress& progress, const RenderArguments& arguments) {
    const FrameDriver& frame = driver.driver();
    PartialCopies copies(output, driver, arguments.outputs);
    const auto step = [&] {
        if (arguments.keepPartial && frame.samples() > 0)
            copies.renew();
        else
            setStopMessage(output.stopMessage());
        report(progress, frame.inTiles() ? "rows" : "samples", static_cast<std::uint64_t>(1000 * output.share()), 1000);
    };
    stopWhenAsked();
    do {
        step();
        if (stopAsked()) return false;
    } while (output.advance());
    setStopMessage("stopped while the finished image was being written; repeat the command");
    return true;
}

void writeImages(const RenderArguments& arguments, const Image& image, SceneDriver& driver, WarningPrinter& warnings) {
    const WriteOptions options = driver.writeOptions();
    const auto hasCurve = [](const std::filesystem::path& path) {
        return !path.string().starts_with("exr:") && !isExr(path);
    };
    if (std::ranges::any_of(arguments.outputs, hasCurve)) warnings.print(clippingWarnings(image, options));
    const Metadata metadata = driver.metadata();
    const std::optional<LayerImages> layers = driver.layerImages();
    for (const std::filesystem::path& path : arguments.outputs) {
        if (isStandardOutput(path))
            writeOutput(path, image, metadata, options);
        else
            writePicture(path, image, layers ? &*layers : nullptr, *driver.frame().scene, driver.frame().world.pose,
                         arguments.request.exrNames, metadata, options);
    }
}

// Writes the image of the samples drawn so far if RenderArguments::keepPartial is set. Always throws Error, with the
// message about the stop.
[[noreturn]] void endStopped(const RenderArguments& arguments, FrameOutput& output, SceneDriver& driver) {
    const std::optional<PartialImage> partial = partialImage(output, driver);
    if (!partial) fail("{}", output.stopMessage());
    endWithoutSecondThread();
    fail("{}", writePartial(arguments.outputs, *partial));
}

void writeAllAovs(const RenderArguments& arguments, SceneDriver& driver, bool quiet) {
    if (!arguments.aovs.any()) return;
    const Metadata metadata = driver.metadata();
    if (arguments.aovs.surfaces()) writeAovs(arguments, driver.aovs(), metadata);
    if (arguments.aovs.work) writeWork(arguments, driver.driver().plan(), driver.work(), metadata, quiet);
}

void runRender(const RenderArguments& arguments, const GlobalOptions& global) {
    const Clock::time_point start = Clock::now();
    checkOutputs(arguments);
    Progress progress = terminalProgress(global);
    SceneDriver driver(nullptr, arguments.request, global.shaderDir, progress);
    FrameOutput output(driver, filesOf(arguments));
    output.start(progress);

    // Print warnings early, before the frame is drawn.
    progress = {};  // ends the progress line
    WarningPrinter warnings(global);
    printCacheUse(driver.frame(), global);
    warnings.print(driver.warnings());
    progress = terminalProgress(global);
    const bool complete = draw(output, driver, progress, arguments);
    progress = {};
    if (!complete) endStopped(arguments, output, driver);
    warnings.print(driver.warnings());

    if (const std::optional<Image> image = output.finish()) writeImages(arguments, *image, driver, warnings);
    writeAllAovs(arguments, driver, global.quiet);
    const RenderReport report = driver.report(commandLine(global.words), millisecondsSince(start));
    if (!arguments.stats.empty()) writeOutput(arguments.stats, statsJson(report));
    if (global.verbose) printChoices(driver.context(), report);
    if (!global.quiet) printSummary(arguments, report, output.rowsKept());
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
    command->callback([arguments, &global] {
        if (arguments->lensImages.empty())
            runRender(*arguments, global);
        else
            renderLensImages(*arguments, global);
    });
}

}  // namespace defocus::engine
