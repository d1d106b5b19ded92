// defocus view: shows a scene in a window.

#include <memory>

#include "cli/command.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/file.h"
#include "view/window/session.h"

namespace defocus::engine {

namespace {

void runView(const SessionOptions& options) {
    checkStop(options.request);
    if (shutterSettings(options.request).exactMotion())
        fail("--motion-segments exact cannot be used in the viewer; give a number, such as 16");
    if (!options.screenshot.empty()) {
        checkImageExtension(options.screenshot);
        checkWritable(options.screenshot);
    }
    if (!options.stats.empty()) checkWritable(options.stats);
    runSession(options);
}

}  // namespace

void addViewCommand(CLI::App& program, const GlobalOptions& global) {
    auto options = std::make_shared<SessionOptions>();
    CLI::App* command = program.add_subcommand("view", "Open an interactive viewer to look around, focus and compare");
    const char* group = "Window";
    addInteger(*command, "--frames", options->frames, 1, 1'000'000,
               "Close the window after it has drawn the scene N times. Default: keep it open")
        ->default_str("")
        ->group(group);
    command
        ->add_option("--screenshot", options->screenshot,
                     "Image file for the last frame. Without --frames, the window closes after one frame")
        ->type_name("FILE")
        ->group(group);
    advanced(command
                 ->add_option("--stats", options->stats,
                              "JSON file that is updated several times per second with the state of the view: focus, "
                              "samples, times and more")
                 ->type_name("FILE")
                 ->group(group));
    addSettings(*command, options->request, settingsOf(pictureGroups, {"timeLimit", "exrLayers", "exrNames"}));
    addMethodSettings(*command, options->request);
    addDeveloperSettings(*command, options->request, {"memory", "threads"});
    command->footer(
        "Press ? in the window for the keys.\n\nExamples:\n"
        "  defocus view scene.glb --fstop 1.4\n"
        "  defocus view --screenshot window.png --frames 60");
    command->callback([options, &global] {
        if (!options->screenshot.empty() && options->frames == 0) options->frames = 1;
        options->shaderFolder = global.shaderDir;
        options->quiet = global.quiet;
        // The window accumulates samples without limit; this number applies to still images that it exports.
        if (!options->request.samples) options->request.samples = RenderSettings{}.sampleCount;
        runView(*options);
    });
}

}  // namespace defocus::engine
