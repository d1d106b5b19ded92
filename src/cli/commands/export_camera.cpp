// defocus export-camera: writes a camera with its lens as USD text, glTF or JSON.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "capture/shot_json.h"
#include "cli/command.h"
#include "cli/options/image_output.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/message.h"
#include "frame/setup/moment.h"
#include "frame/setup/prepared_frame.h"
#include "lens/lens_fields.h"
#include "scene/camera_files/camera_gltf.h"
#include "scene/camera_files/camera_json.h"
#include "scene/camera_files/camera_usda.h"

namespace defocus::engine {

namespace {

struct ExportArguments {
    Request request;
    std::filesystem::path output = "camera.usda";
    std::optional<FrameRange> range;
    double frameRate = 24;
};

using TextOf = std::string (*)(const CameraTake&);

TextOf writerFor(const std::filesystem::path& output) {
    const std::string extension = output.extension().string();
    if (extension == ".usda") return cameraUsdaText;
    if (extension == ".gltf") return cameraGltfText;
    if (extension == ".json") return cameraJsonText;
    throw UsageError(
        fmt::format("--output: {}: give a file name that ends with .usda, .gltf or .json", output.string()));
}

// Returns the lens values to write: some of them always, the others only if they differ from their defaults.
std::map<std::string, double, std::less<>> lensOf(const Lens& lens) {
    constexpr double farthest = 1e12;  // distance in m for a focus at infinity
    const Lens defaults;
    std::map<std::string, double, std::less<>> values;
    for (const LensField& field : lensFields()) {
        const std::string_view name = field.name;
        const bool always =
            name == "focalLength" || name == "horizontalAperture" || name == "fStop" || name == "focusDistance";
        const double value = lensFieldValue(lens, field);
        if (always || value != lensFieldValue(defaults, field)) values[field.name] = std::min(value, farthest);
    }
    return values;
}

CameraSample sampleOf(const PreparedFrame& frame, double time) {
    return {time, frame.view.worldFromCamera, frame.view.nearPlane, lensOf(frame.view.lens)};
}

void runExportCamera(const ExportArguments& arguments, const GlobalOptions& global) {
    const TextOf textOf = writerFor(arguments.output);
    checkImageOutputs({}, {arguments.output}, {arguments.request.scene, arguments.request.cameraFrom});
    const PreparedFrame first = placeFrame(arguments.request, terminalProgress(global));
    WarningPrinter warnings(global);
    warnings.print(frameWarnings(first));
    if (first.view.lens.apertureImage)
        warnings.print(
            {"the aperture image is not exported; give --aperture-image "
             "again when you render with the exported camera"});

    CameraTake take;
    take.name = first.cameraName.empty() ? "Camera" : first.cameraName;
    take.aspect = static_cast<double>(arguments.request.size.width) / arguments.request.size.height;
    take.frameRate = arguments.frameRate;
    if (!arguments.range) take.samples.push_back(sampleOf(first, arguments.request.time));
    if (arguments.range)
        for (int frame = arguments.range->first; frame <= arguments.range->last; ++frame) {
            Request request = arguments.request;
            request.time = frame / arguments.frameRate;
            // Export the camera at the frame's time, not at the middle of the exposure.
            request.shutter = 0;
            take.samples.push_back(sampleOf(placeFrame(first.scene, request, &first.world.environment), request.time));
        }
    if (const ShutterSettings shutter = shutterOf(arguments.request, *first.scene); shutter.seconds > 0) {
        const double middle = shutterMiddle(shutter);
        take.shutter = ShutterInterval{middle - shutter.seconds / 2, middle + shutter.seconds / 2};
    }
    writeOutput(arguments.output, textOf(take));
    if (!global.quiet)
        printMessage("{}: camera '{}', {} {}\n", arguments.output.string(), take.name, take.samples.size(),
                     take.samples.size() == 1 ? "frame" : "frames");
}

}  // namespace

void addExportCameraCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command =
        program.add_subcommand("export-camera", "Write a camera with its lens as USD text, glTF or JSON");
    addSettings(*command, arguments->request, sceneSettings);
    command
        ->add_option("-o,--output", arguments->output,
                     "File to write: .usda, .gltf with lens values as extras, or .json")
        ->type_name("FILE")
        ->capture_default_str();
    addParsed(
        *command, "--range", "FIRST:LAST",
        "Frames to write as an animation; frame 0 is the start of the animation. Default: a single frame, at --time",
        [arguments](const std::string& text) { arguments->range = parseFrameRange(text); });
    addNumber(*command, "--frame-rate", arguments->frameRate, {1e-3, 1e6}, "FPS",
              "Frame rate in frames per second, for --range and the time codes of .usda");
    addSettings(*command, arguments->request,
                settingsOf({SettingGroup::camera, SettingGroup::lens}, {"nodeBlur", "apertureImage"}));
    addSettings(*command, arguments->request, {"units", "time", "clip", "loop", "shutter", "shutterPosition"});
    command->footer(
        "Examples:\n"
        "  defocus export-camera scene.glb -o shot.usda --range 0:120 --fstop 1.4\n"
        "  defocus render scene.glb --camera-from shot.usda:/World/Camera -o out.exr");
    command->callback([arguments, &global] { runExportCamera(*arguments, global); });
}

}  // namespace defocus::engine
