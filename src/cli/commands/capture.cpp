// defocus capture: renders a shot to image files and a video.

#include "capture/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capture/frame_files.h"
#include "capture/pop_check.h"
#include "capture/shot_json.h"
#include "capture/shot_options.h"
#include "capture/video.h"
#include "cli/command.h"
#include "cli/commands/capture_refocus.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "cli/terminal/stop_signal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "core/stopwatch.h"
#include "frame/report/picture_warnings.h"
#include "frame/report/plan_warnings.h"
#include "frame/setup/exposure.h"
#include "frame/setup/prepared_frame.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

constexpr int maxShards = 1'000'000;

struct CaptureArguments {
    std::vector<ShotOverride> overrides;
    Shot shot;
    Request request = shotDefaults();
    std::optional<FrameRange> range;
    Share shard;
    std::optional<SampleRange> sampleRange;
    std::vector<std::string> outputs;  // file name patterns from the command line; empty: those of the shot are used
    bool resume = false;
    bool overwrite = false;
    bool dryRun = false;
    bool check = false;    // true: measure image changes caused by levels of detail
    bool refocus = false;  // true: compute frames from lens images where possible
};

// Checks the outputs and the combination of options before anything is rendered. Throws Error for invalid outputs and
// combinations.
void checkArguments(const CaptureArguments& arguments) {
    for (const std::string& pattern : arguments.shot.outputs) {
        checkFramePattern(pattern);
        const fs::path folder = fs::path(pattern).parent_path();
        std::error_code fault;
        if (!folder.empty() && !arguments.dryRun) fs::create_directories(folder, fault);
        if (fault) fail("cannot create the folder {}: {}", folder.string(), fault.message());
        if (!arguments.dryRun) checkWritable(framePath(pattern, 0));
    }
    if (arguments.refocus && (arguments.sampleRange || arguments.check || arguments.request.targetError))
        throw UsageError("--refocus cannot be combined with --sample-range, --check or --target-error");
    if (arguments.refocus && !arguments.request.layers.empty())
        throw UsageError("--refocus computes images without layers; leave out --exr-layers");
    const bool part = arguments.shard.count > 1 || arguments.sampleRange;
    if (!arguments.shot.video.empty()) {
        if (part)
            fail(
                "--video needs all frames; run all shards first, then repeat the command without --shard but with "
                "--resume --video {}",
                arguments.shot.video.string());
        checkVideo(arguments.shot.video);
    }
    if (!arguments.sampleRange) return;
    if (arguments.request.targetError)
        throw UsageError("--sample-range cannot be combined with --target-error; give --samples");
    checkSampleRange(*arguments.sampleRange, arguments.request.samples.value_or(maxSamples));
    if (arguments.shot.outputs.size() != 1 || fs::path(arguments.shot.outputs.front()).extension() != ".exr")
        fail(
            "--sample-range writes sums of samples to EXR files named after the output; give one .exr output, such as "
            "-o frames/####.exr");
}

FilmOptions filmOptions(const CaptureArguments& arguments, const FilmSettings& settings) {
    const Shot& shot = arguments.shot;
    FilmOptions options;
    options.outputs = shot.outputs;
    options.sampleRange = arguments.sampleRange;
    options.settings = settings;
    options.timings = timingsPath(shot.outputs.front(), arguments.shard.index, arguments.shard.count);
    options.resume = arguments.resume;
    return options;
}

// Replaces method "auto" by one method for all frames, so that the look doesn't change within the shot. Chooses a
// method for up to 16 frames, spread over the complete shot. Uses multirate if it is chosen for any of these frames,
// else accumulation.
void settleMethod(Request& request, const Shot& shot, PreparedFrame placed, const SequenceBase& base) {
    const MethodUse use = chosenMethod(request);
    if (use.method->name != automaticMethod) return;
    // Plan the frames without levels of detail, because these don't affect the choice of the method.
    placed.settings.lod = LodMode::off;
    addPyramids(placed);
    constexpr int maxPlanned = 16;
    const FrameRange& range = shot.range;
    const int steps = std::min(maxPlanned - 1, range.last - range.first);
    for (int i = 0; i <= steps && request.method != "multirate"; ++i) {
        const int number = range.first + (range.last - range.first) * i / std::max(steps, 1);
        FrameMoment frame = frameAt(shot, base, number);
        frame.settings.lod = LodMode::off;
        applyMoment(frame, placed.world);
        request.method = drawnMethod(use, planFrame(placed.world, frame.view, frame.settings)).method->name;
    }
}

void printPlan(const Shot& shot, SceneDriver& driver, const SequenceBase& base, const std::vector<FilmFrame>& film,
               const FilmOptions& options) {
    const Request& request = options.settings.request;
    const StopSettings stop = stopSettings(request);
    const std::string samples = stop.targetError ? fmt::format("samples until the error is {:g}", *stop.targetError)
                                : stop.automatic ? "as many samples as each frame needs"
                                                 : fmt::format("{} samples", base.settings.sampleCount);
    fmt::print("{}, camera '{}', {}x{}, {}, method {}, {:g} frames per second\n", driver.frame().sceneName,
               driver.frame().cameraName, base.view.width, base.view.height, samples, chosenMethod(request).text(),
               shot.frameRate);
    fmt::print("{:>7} {:>9} {:>10} {:>8} {:>8} {:>12}  {}\n", "frame", "time, s", "focus, m", "f-stop", "mm",
               "triangles", "file");
    for (const FilmFrame& each : film) {
        const FrameMoment frame = frameAt(shot, base, each.frame);
        driver.pose(request, frame);
        const FramePlan plan = planFrame(driver.frame().world, frame.view, frame.settings);
        const Lens& lens = frame.view.lens;
        fmt::print("{:>7} {:>9.3f} {:>10.4g} {:>8.3g} {:>8.4g} {:>12}  {}{}\n", each.frame, frame.time,
                   lens.focusDistance, lens.fStop, lens.focalLength, plan.trianglesDrawn, each.files.front().string(),
                   each.finished                                ? " (finished)"
                   : runOf(options.runs, each.frame) != nullptr ? " (refocused)"
                   : each.other.empty()                         ? ""
                                                                : " (other settings)");
    }
}

// Meters the shot's first frame, even if this run doesn't render that frame, and sets the exposure of all frames.
void meterFilm(const Shot& shot, SceneDriver& driver, const SequenceBase& base, const Request& request,
               std::vector<FilmFrame>& film) {
    driver.pose(request, frameAt(shot, base, shot.range.first));
    const double exposure = driver.writeOptions().exposure;
    for (FilmFrame& each : film) each.write.exposure = exposure;
}

void printFigures(const FilmFigures& figures, std::size_t frames) {
    const double render = figures.renderMilliseconds / 1000;
    const double total = figures.totalMilliseconds / 1000;
    std::string text = fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
    if (figures.finishedBefore > 0) text += fmt::format(", {} of them from earlier runs", figures.finishedBefore);
    if (figures.rendered > 0)
        text += fmt::format(
            ": {} rendered and written in {:.1f} s; rendering alone took {:.1f} s ({:.0f} ms and {:.2f} M triangles "
            "per frame)",
            figures.rendered, total, render, 1000 * render / figures.rendered,
            static_cast<double>(figures.triangles) * 1e-6 / figures.rendered);
    if (figures.tiles > 1) text += fmt::format(", each in {} tiles", figures.tiles);
    printMessage("{}\n", text);
}

void printPops(const PopCheck& check) {
    std::string text =
        fmt::format("level-of-detail pops in {} frame pair{}: ", check.compared(), check.compared() == 1 ? "" : "s");
    if (const std::optional<FramePop>& pop = check.largest())
        text += fmt::format(
            "the largest has an RMSE of {:.4f}, in the pixels of '{}' from frame {} to {}; for comparison, other "
            "sample positions (another seed) change these pixels by an RMSE of {:.4f}",
            pop->rmse, pop->object, pop->frame - 1, pop->frame, pop->seedRmse);
    else
        text += "none, because no object changes its level of detail";
    if (check.incomparable() > 0)
        text += fmt::format(
            "; frame pairs that cannot be compared, because their numbers of samples differ: {}; give --samples N",
            check.incomparable());
    printMessage("{}\n", text);
}

FilmFigures renderFrames(const CaptureArguments& arguments, SceneDriver& driver, const SequenceBase& base,
                         const std::vector<FilmFrame>& film, FilmOptions& options, const GlobalOptions& global,
                         const Progress& progress) try {
    const Request& request = options.settings.request;
    std::optional<PopCheck> check;
    if (arguments.check) {
        driver.makeCurrent();
        const RendererOptions renderer{.layerFormat = request.layerFormat, .shaderFolder = global.shaderDir};
        check.emplace(driver.frame().world, chosenMethod(request), renderer);
        options.frameDrawn = [&](int frame, const FramePlan& plan) { check->note(frame, plan); };
    }
    stopWhenAsked();
    // With a time limit, render at least one frame, so that repeated runs eventually finish.
    const Clock::time_point start = Clock::now();
    bool first = true;
    setStopMessage("stopped during a frame: finished frames are kept; repeat the command with --resume to continue");
    const auto stop = [&] {
        const std::optional<double> limit = arguments.request.timeLimit;
        const bool late = limit && !std::exchange(first, false) && millisecondsSince(start) > 1000 * *limit;
        return stopAsked() || late;
    };
    const FilmFigures figures = renderFilm(arguments.shot, base, driver, film, options, stop, progress);
    if (check) printPops(*check);
    return figures;
} catch (const Error& error) {
    fail("{} (finished frames are kept; repeat the command with --resume to continue)", error.what());
}

// Throws Error if frames made with other settings, which may have taken hours, would be replaced.
void refuseToReplace(const std::vector<FilmFrame>& film) {
    const auto replaced = [](const FilmFrame& frame) { return !frame.other.empty(); };
    const auto first = std::ranges::find_if(film, replaced);
    if (first == film.end()) return;
    const auto more = std::ranges::count_if(film, replaced) - 1;
    fail("{}{} rendered with other settings; replace with --overwrite, or give another output with -o",
         first->other.string(),
         more > 0 ? fmt::format(" and {} more frame{} were", more, more > 1 ? "s" : "") : " was");
}

PreparedFrame placedFrame(const Shot& shot, const Request& request, const Progress& progress) try {
    return placeFrame(request, progress);
} catch (const MissingName& missing) {
    failForName(shot, missing);
}

void runCapture(CaptureArguments& arguments, const GivenOptions& given, const GlobalOptions& global) {
    // Check options, outputs, scene, device, and each frame's camera and lens before any frame is rendered.
    Shot& shot = arguments.shot;
    settleShot(shot, arguments.request, given);
    if (!arguments.outputs.empty()) shot.outputs = arguments.outputs;
    checkArguments(arguments);
    Request request = arguments.request;
    request.timeLimit.reset();  // limits the run, not a frame: a frame must have the same samples in every run
    Progress progress = terminalProgress(global);
    checkRequest(request);  // before the scene is loaded
    SceneDriver driver(placedFrame(shot, request, progress), request, global.shaderDir);
    const PreparedFrame& placed = driver.frame();
    const SequenceBase base = sequenceBase(placed, request);
    if (arguments.refocus && chosenMethod(request).method->name == automaticMethod) request.method = "accumulation";
    settleMethod(request, shot, placed, base);
    const MethodUse use = chosenMethod(request);
    FilmOptions options = filmOptions(arguments, filmSettings(placed, request, global.shaderDir));
    if (arguments.refocus && use.method->name != "accumulation")
        throw UsageError(
            fmt::format("--refocus requires --method accumulation, not '{}'; leave out --method", use.text()));
    RefocusRuns runs;
    if (arguments.refocus) runs = chosenRuns(shot, base, options.settings);
    options.runs = runs.runs;
    options.metered = metersExposure(request, *placed.scene, placed.view.lens);
    const std::vector<int> frames =
        shardFrames(arguments.range.value_or(shot.range), arguments.shard.index, arguments.shard.count);
    std::vector<FilmFrame> film = filmFrames(shot, base, frames, options, progress);
    if (arguments.resume && !arguments.overwrite && !arguments.dryRun) refuseToReplace(film);
    const bool allThere = std::ranges::all_of(film, &FilmFrame::finished);

    const bool meters = options.metered && (!allThere || !shot.video.empty());
    if (((!allThere && use.method->needsGl) || meters) && !arguments.dryRun) driver.openContext();
    if (!allThere || meters || arguments.dryRun) driver.buildPyramids(progress);
    progress = {};
    printCacheUse(placed, global);
    WarningPrinter warnings(global);
    // Frames set the time and the seed of the request; the warnings are about the request as the user gave it.
    driver.pose(request, momentOf(placed, request));
    warnings.print(driver.warnings());
    warnings.print(runs.rendered);
    if (!allThere) {
        driver.pose(request, frameAt(shot, base, film.front().frame));
        warnings.print(planWarnings(planFrame(placed.world, placed.view, placed.settings), use));
    }
    if (arguments.dryRun) return printPlan(shot, driver, base, film, options);
    if (meters) meterFilm(shot, driver, base, request, film);
    progress = terminalProgress(global);
    if (!shot.video.empty() || !std::ranges::all_of(shot.outputs, isExr))
        options.firstDrawn = [&](const Image& image, const WriteOptions& write) {
            progress = {};  // end the progress line before the warnings
            warnings.print(clippingWarnings(image, write));
            progress = terminalProgress(global);
        };
    FilmFigures figures;
    figures.finishedBefore = static_cast<int>(film.size());
    if (!allThere) figures = renderFrames(arguments, driver, base, film, options, global, progress);
    if (figures.stoppedBefore)
        fail("stopped before frame {}: {} of {} frames are finished; repeat the command with --resume to continue",
             *figures.stoppedBefore, figures.rendered + figures.finishedBefore, film.size());

    std::vector<VideoFrame> pictures;
    for (const FilmFrame& frame : film) pictures.push_back({frame.files.front(), frame.write});
    if (!shot.video.empty()) writeVideo(shot.video, pictures, shot.frameRate, progress);
    progress = {};
    if (global.quiet) return;
    printFigures(figures, film.size());
    const std::string saving =
        arguments.refocus ? savedText(options.settings, figures) : possibleSaving(shot, base, options.settings, film);
    if (!saving.empty()) printMessage("{}\n", saving);
}

// Adds the shot and the options that replace parts of the shot. CLI11 applies options in the order in which they were
// added: --set, which applies while the shot is read, must precede the shot, and the overriding options must follow the
// shot.
void addShot(CLI::App& command, CaptureArguments& arguments) {
    const char* group = "Shot";
    advanced(command
                 .add_option_function<std::vector<std::string>>(
                     "--set",
                     [&arguments](const std::vector<std::string>& texts) {
                         try {
                             for (const std::string& text : texts)
                                 arguments.overrides.push_back(parseShotOverride(text));
                         } catch (const Error& error) {
                             throw CLI::ValidationError(error.what());  // CLI11 reports this as a command-line error
                         }
                     },
                     "Replace a value of the shot, given by its JSON pointer, such as --set /lens/fStop=1.4. Can be "
                     "given several times")
                 ->allow_extra_args(false)
                 ->type_name("/PLACE=VALUE")
                 ->group(group));
    command
        .add_option_function<std::string>(
            "SHOT",
            [&arguments](const std::string& path) {
                arguments.shot = loadShot(path, arguments.overrides);
                applyShot(arguments.shot, arguments.request);
            },
            "Shot file (JSON, see docs/shots.md)")
        ->required()
        ->type_name("FILE");
    addParsed(command, "--range", "FIRST:LAST",
              "First and last frame to render, or a single frame. The movement of a turntable or dolly still takes all "
              "frames of the shot",
              [&arguments](const std::string& text) { arguments.range = parseFrameRange(text); })
        ->group(group);
    addNumber(command, "--frame-rate", arguments.shot.frameRate, {1e-3, 1e6}, "FPS", "Frame rate in frames per second")
        ->group(group);
    advanced(addNumber(command, "--speed", arguments.shot.animationSpeed, {-1e3, 1e3}, "R",
                       "Speed factor of the scene's animation; negative: backwards")
                 ->group(group));
    advanced(command
                 .add_flag("--animate-seed", arguments.shot.animateSeed,
                           "Change the sample positions from frame to frame, so that noise looks like film grain")
                 ->group(group));
}

void addOutputs(CLI::App& command, CaptureArguments& arguments) {
    const char* group = "Output";
    command
        .add_option("-o,--output", arguments.outputs,
                    "File pattern of the frames, with #### for the frame number: .exr, .png or .jpg. Can be given "
                    "several times. Default: from the shot, else frames/####.exr")
        ->allow_extra_args(false)
        ->type_name("PATTERN")
        ->group(group);
    command
        .add_option("--video", arguments.shot.video, "Also encode a video with ffmpeg: .mp4, .mov, .mkv, .webm or .gif")
        ->type_name("FILE")
        ->group(group);
    CLI::Option* resume =
        command
            .add_flag("--resume", arguments.resume, "Keep finished frames that were rendered with the same settings")
            ->group(group);
    command
        .add_flag("--overwrite", arguments.overwrite,
                  "With --resume: replace frames that were rendered with other settings")
        ->needs(resume)
        ->group(group);
    advanced(addParsed(command, "--shard", "I/N",
                       "Render only part I (0 to N-1) of the frames, to share a shot between N machines",
                       [&arguments](const std::string& text) { arguments.shard = parseShare(text, "part", maxShards); })
                 ->group(group));
    advanced(addParsed(command, "--sample-range", "FIRST:END",
                       "Draw only lens samples FIRST to END-1 of each frame. For 'defocus merge', their sums are "
                       "written to NAME.partFIRST-END.exr instead of NAME.exr. FIRST and END are multiples of 64; END "
                       "can also be the number of samples",
                       [&arguments](const std::string& text) { arguments.sampleRange = parseSampleRange(text); })
                 ->group(group));
    command.add_flag("--dry-run", arguments.dryRun, "Print the plan of each frame without rendering")->group(group);
    command
        .add_flag(
            "--refocus", arguments.refocus,
            "Where the scene is still and consecutive frames differ only in focus, f-number or aperture shape, render "
            "one set of lens images and compute these frames from the set")
        ->group(group);
    command
        .add_flag("--check", arguments.check,
                  "Measure pops, the visible jumps when a level of detail changes between frames, and print the "
                  "largest. Takes up to four times as long")
        ->group(group);
}

}  // namespace

void addCaptureCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<CaptureArguments>();
    CLI::App* command = program.add_subcommand("capture", "Render a shot (keyframes, focus pulls) to frames and video");
    addShot(*command, *arguments);
    addOutputs(*command, *arguments);
    addSettings(*command, arguments->request, settingsOf(pictureGroups, {"scene"}));
    command->add_option("--scene", arguments->request.scene, "glTF file that replaces the scene of the shot")
        ->type_name("FILE")
        ->group("Scene");
    addMethodSettings(*command, arguments->request);
    addDeveloperSettings(*command, arguments->request);
    command->footer(
        "Options override the shot.\n\n"
        "Examples:\n"
        "  defocus capture shots/fish-pull.json --video fish.mp4\n"
        "  defocus capture shot.json --range 0:48 --samples 16 --size 320x240 -o preview/####.png\n"
        "  defocus capture shot.json --shard 2/8 --resume");
    command->callback([arguments, command, &global] {
        const auto given = [command](const char* name) { return command->get_option(name)->count() > 0; };
        runCapture(*arguments,
                   {.camera = given("--camera") || given("--camera-from"),
                    .shutter = given("--shutter"),
                    .samples = given("--samples")},
                   global);
    });
}

}  // namespace defocus::engine
