// defocus new-shot: writes an initial shot file for a scene.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/command.h"
#include "cli/options/request_options.h"
#include "cli/options/shot_schema_text.h"
#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int frameRate = 24;
constexpr int stillSeconds = 5;  // duration of the shot of a scene without animation, s
constexpr const char* schemaName = "shot.schema.json";

struct NewShotArguments {
    Request request;
    fs::path output;  // file to write; empty: named after the scene
    bool overwrite = false;
};

// Rounds to three significant digits.
double rounded(double value) {
    const double step = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
    return std::isfinite(step) && step > 0 ? std::stod(fmt::format("{:.3g}", value)) : value;
}

// Returns a shot that shows the settings users are likely to change: the f-stop, an automatic focus, and a turntable if
// the scene has no animation.
Json shotOf(const PreparedFrame& frame, const fs::path& scene, const std::string& stem) {
    const Scene& file = *frame.scene;
    Json shot = {{"$schema", schemaName}};
    if (!scene.empty()) shot["scene"] = scene.generic_string();
    double seconds = stillSeconds;
    if (!file.clips.empty()) {
        const AnimationClip& clip = file.clips.front();
        seconds = std::max(1.0 / frameRate, static_cast<double>(clip.duration));
        shot["animation"] = {{"clip", clip.name.empty() ? Json(0) : Json(clip.name)}, {"loop", true}};
    }
    shot["range"] = {0, std::max(0, static_cast<int>(std::lround(seconds * frameRate)) - 1)};
    shot["frameRate"] = frameRate;
    shot["size"] = {1280, 720};
    if (file.clips.empty()) shot["camera"] = {{"turntable", {{"turns", 1}}}};
    shot["focus"] = {{"auto", true}};
    shot["lens"] = {{"fStop", rounded(frame.view.lens.fStop)}};
    shot["output"] = stem + "/####.exr";
    return shot;
}

void refuseToReplace(const fs::path& path) {
    if (fs::exists(path))
        fail("{} already exists; replace it with --overwrite, or give another name with -o", path.string());
}

void runNewShot(const NewShotArguments& arguments, const GlobalOptions& global) {
    const fs::path& scene = arguments.request.scene;
    const fs::path stem = scene.empty() ? fs::path("fish") : scene.stem();
    const fs::path output = arguments.output.empty() ? fs::path(stem.string() + ".json") : arguments.output;
    if (!arguments.overwrite) refuseToReplace(output);
    checkWritable(output);
    const PreparedFrame frame = placeFrame(arguments.request, terminalProgress(global));
    const fs::path folder = output.parent_path();
    const fs::path fromShot = scene.empty() ? scene : fs::proximate(scene, folder.empty() ? "." : folder);
    static const std::regex pair("\\[\\s+(\\d+),\\s+(\\d+)\\s+\\]");  // two numbers that dump() puts on separate lines
    const std::string text = shotOf(frame, fromShot, stem.string()).dump(2);
    writeFile(output, std::regex_replace(text, pair, "[$1, $2]") + "\n");

    // Write the schema, which the shot's first line refers to, to the same folder.
    if (!fs::exists(folder / schemaName)) writeFile(folder / schemaName, shotSchemaText(), NamedBy::program);
    if (!global.quiet) printMessage("wrote {0}; render it with: defocus capture {0}\n", output.string());
}

}  // namespace

void addNewShotCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<NewShotArguments>();
    CLI::App* command = program.add_subcommand("new-shot",
                                               "Create a shot file for a scene, which you can edit and "
                                               "render with 'defocus capture'");
    addSettings(*command, arguments->request, {"scene"});
    command
        ->add_option("-o,--output", arguments->output,
                     "Shot file to write. Its JSON schema is written beside it, for text editors. Default: SCENE.json "
                     "in the current folder")
        ->type_name("FILE");
    command->add_flag("--overwrite", arguments->overwrite, "Replace an existing shot file");
    command->footer(
        "Example:\n"
        "  defocus new-shot scene.glb\n"
        "  defocus capture scene.json --video scene.mp4");
    command->callback([arguments, &global] { runNewShot(*arguments, global); });
}

}  // namespace defocus::engine
