// defocus refocus: computes pictures with another focus, f-number and aperture from a file of lens images, which holds
// one image per lens sample.

#include "refocus/refocus.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cli/command.h"
#include "cli/commands/refocus_series.h"
#include "cli/options/image_output.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "core/stopwatch.h"
#include "refocus/page.h"
#include "refocus/refocus_settings.h"

namespace defocus::engine {

namespace {

// Returns the names of the settings that this command shares with `defocus render`.
std::vector<std::string> ownSettings() {
    std::vector<std::string> names = refocusSettings();
    names.emplace_back("toneMap");
    return names;
}

struct RefocusArguments {
    std::filesystem::path file;
    std::vector<std::filesystem::path> outputs = {"out.exr"};
    Request request;                 // only the settings listed by ownSettings() are used
    std::optional<double> exposure;  // exposure in EV; nullopt: as rendered
    std::filesystem::path page;      // if not empty, write an interactive web page to this file instead of images
    FocusPullFilm pull;              // video of a focus pull; written if pull.video isn't empty
    // true: blur each lens image, so that points out of focus don't appear as separate copies, one per lens image
    bool fillGaps = true;
    int stack = 0;  // number of pictures in a focal stack; 0: write one picture
};

Refocusing requested(const RefocusArguments& arguments, LightField& field) {
    return refocusingOf({arguments.request.focus, arguments.request.lens, arguments.fillGaps}, field);
}

void writePage(const RefocusArguments& arguments, const GlobalOptions& global) {
    const std::string extension = arguments.page.extension().string();
    if (extension != ".html" && extension != ".htm")
        throw UsageError(fmt::format("--html writes a web page; give a file name that ends with .html, not '{}'",
                                     arguments.page.string()));
    checkImageOutputs({}, {arguments.page}, {arguments.file});
    if (apertureShape(arguments.request.lens))
        throw UsageError("--html lets the visitor choose the aperture shape; leave out options such as --blades");
    LightField field(arguments.file);
    const Refocusing start = requested(arguments, field);
    const WriteOptions write{arguments.request.toneMap,
                             arguments.exposure.value_or(refocusedExposure(field.info(), start))};
    const std::string page =
        refocusPage(field, arguments.file.stem().stem().string(), start, write, terminalProgress(global));
    writeFile(arguments.page, page);
    if (!global.quiet)
        printMessage("{}: {} images, {:.1f} MB\n", arguments.page.string(),
                     std::min(field.info().points.size(), maxPageImages), static_cast<double>(page.size()) / 1e6);
}

// Writes one picture to all outputs.
void writePicture(const RefocusArguments& arguments, LightField& field, const Refocusing& refocusing,
                  const WriteOptions& write, const GlobalOptions& global) {
    const Clock::time_point start = Clock::now();
    const Image image = refocused(field, refocusing, terminalProgress(global));
    const Metadata metadata = refocusedMetadata(field.info(), refocusing);
    for (const std::filesystem::path& path : arguments.outputs) writeOutput(path, image, metadata, write);
    if (!global.quiet)
        printMessage("{}: {}x{}, focus at {:.4g} m, f/{:g}, {} of {} lens images in {:.2f} s\n",
                     shownOutputs(arguments.outputs), image.width, image.height, refocusing.focusDistance,
                     refocusing.fStop, shiftedImages(field.info(), refocusing, field.name()).size(),
                     field.info().points.size(), millisecondsSince(start) / 1000);
}

void runRefocus(const RefocusArguments& arguments, const GlobalOptions& global) {
    const bool films = !arguments.pull.video.empty();
    const std::vector<std::filesystem::path> inputs = {arguments.file, arguments.request.lens.apertureImage};
    if (films)
        checkImageOutputs({}, {arguments.pull.video}, inputs);
    else
        checkImageOutputs(arguments.outputs, {}, inputs);
    if (arguments.stack > 0 && arguments.outputs.size() > 1)
        throw UsageError("--stack names its files after one output; give -o once");
    if ((films || arguments.stack > 0) && !std::holds_alternative<CameraFocus>(arguments.request.focus))
        throw UsageError(
            "--focus-pull and --stack set the focus distances; leave out --focus-distance and --focus-pixel");
    LightField field(arguments.file);
    const Refocusing refocusing = requested(arguments, field);
    const WriteOptions write{arguments.request.toneMap,
                             arguments.exposure.value_or(refocusedExposure(field.info(), refocusing))};
    if (films)
        writeFocusPull(field, refocusing, arguments.pull, write, global);
    else if (arguments.stack > 0)
        writeFocalStack(field, refocusing, arguments.stack, arguments.outputs.front(), write, global);
    else
        writePicture(arguments, field, refocusing, write, global);
}

}  // namespace

void addRefocusCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<RefocusArguments>();
    CLI::App* command = program.add_subcommand(
        "refocus", "Choose focus, f-number and bokeh of an image after rendering (render --lens-images)");
    command->add_option("FILE", arguments->file, "File of lens images, from 'defocus render --lens-images'")
        ->required()
        ->type_name("FILE");
    addImageOutputs(*command, arguments->outputs);
    addNumber(*command, "--exposure", arguments->exposure, {-60, 60}, "EV",
              "Exposure in EV for PNG and JPEG. Default: as rendered");
    CLI::Option* const fills =
        command->add_flag("--fill-gaps,!--no-fill-gaps", arguments->fillGaps,
                          "Blur each lens image slightly, so that a point out of focus appears as one disk, not as "
                          "separate copies (default). --no-fill-gaps is faster");
    addParsed(*command, "--html", "FILE",
              fmt::format("Write a web page in which visitors choose focus, f-number and bokeh. It contains at most {} "
                          "lens images. Replaces --output",
                          maxPageImages),
              [arguments](const std::string& text) { arguments->page = text; })
        ->excludes("--output")
        ->excludes(fills);
    CLI::Option* const pull =
        addParsed(*command, "--focus-pull", "A:B",
                  "Make a video of a focus pull from distance A to distance B in m; needs "
                  "--video",
                  [arguments](const std::string& text) { parseFocusPull(text, arguments->pull); });
    CLI::Option* const video =
        addParsed(*command, "--video", "FILE", "Video file of --focus-pull: .mp4, .mov, .mkv, .webm or .gif",
                  [arguments](const std::string& text) { arguments->pull.video = text; });
    pull->needs(video)->excludes("--output")->excludes("--html");
    video->needs(pull);
    addInteger(*command, "--frames", arguments->pull.frames, 2, 100'000, "Number of frames of --focus-pull")
        ->needs(pull);
    addNumber(*command, "--frame-rate", arguments->pull.frameRate, {1e-3, 1e3}, "FPS",
              "Frames per second of --focus-pull")
        ->needs(pull);
    addInteger(*command, "--stack", arguments->stack, 2, 100,
               "Write a focal stack. With -o out.exr: N images (out.00.exr, out.01.exr …), an image with everything in "
               "focus (out.sharp.exr) and depths in m (out.depth.exr). The focus distances cover the focus range of "
               "the lens images (render --focus-range), evenly in 1/distance")
        ->default_str("")
        ->excludes("--html")
        ->excludes(pull);
    addSettings(*command, arguments->request, ownSettings());
    command->get_option("--fstop")->description("f-number, at least that of the lens images. Default: as rendered");
    command->get_option("--focus-distance")
        ->description(
            "Distance of the focus plane along the view axis, such as 2.5 (m) or 50cm, within the focus range "
            "of the lens images. Default: as rendered");
    command->footer(
        "Examples:\n"
        "  defocus render scene.glb --lens-images scene.lens.exr --fstop 1.4 --samples 128\n"
        "  defocus refocus scene.lens.exr -o near.png --focus-distance 1.2\n"
        "  defocus refocus scene.lens.exr -o star.png --focus-pixel 512,384 --fstop 2.8 --blades 6\n"
        "  defocus refocus scene.lens.exr --focus-pull 1:4 --video pull.mp4 --fstop 2\n"
        "  defocus refocus scene.lens.exr --stack 16 -o stack.exr\n"
        "  defocus refocus scene.lens.exr --html scene.html\n"
        "Without --blades and other shape options, the aperture has the rendered shape.");
    command->callback([arguments, &global] {
        if (arguments->page.empty())
            runRefocus(*arguments, global);
        else
            writePage(*arguments, global);
    });
}

}  // namespace defocus::engine
