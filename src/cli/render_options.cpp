#include "cli/render_options.h"

#include <array>

#include "cli/option_text.h"

namespace defocus {

namespace {

void parseAovs(const std::string& text, AovRequest& aovs) {
    const std::vector<std::string> names = {"depth", "coc", "level", "work"};
    const std::array<bool*, 4> wanted = {&aovs.depth, &aovs.coc, &aovs.level, &aovs.work};
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        *wanted[parseChoice(text.substr(begin, end - begin), names)] = true;
        begin = end + 1;
    }
}

void addOutputs(CLI::App& command, RenderArguments& arguments) {
    const char* group = "Output";
    arguments.outputs = {"out.exr"};
    command
        .add_option("-o,--output", arguments.outputs,
                    "Image to write: .exr is linear float with metadata, .png and .jpg are tone-mapped. Can be given "
                    "several times")
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->default_str("out.exr")
        ->group(group);
    addParsed(command, "--aov", "depth,coc,level,work",
              "Also write, beside the first output, out.depth.exr (m), out.coc.exr (signed px), out.level.exr with "
              "out.level.png (level of detail) and out.work.exr with out.work.png (triangles that touch each pixel, "
              "summed over the lens samples of the accumulation, hidden ones too)",
              [&arguments](const std::string& text) { parseAovs(text, arguments.aovs); })
        ->group(group);
    addParsed(command, "--sample-range", "FIRST:END",
              "Sum up only these samples (multiples of 64) of the --samples, to an EXR file for 'defocus merge'",
              [&arguments](const std::string& text) { arguments.sampleRange = parseSampleRange(text); })
        ->group(group);
    command.add_option("--stats", arguments.stats, "Write times, triangles and memory as JSON")
        ->type_name("FILE")
        ->group(group);
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderArguments& arguments) {
    addOutputs(command, arguments);
    addSettings(command, arguments.request, settingsOf(pictureGroups));
    addMethodSettings(command, arguments.request);
    addDeveloperSettings(command, arguments.request);
}

}  // namespace defocus
