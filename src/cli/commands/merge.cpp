// defocus merge: merges parts of a frame (subsets of its samples or of its rows) into the complete frame.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "cli/command.h"
#include "cli/options/image_output.h"
#include "cli/options/option_text.h"
#include "core/error.h"
#include "core/file.h"
#include "core/message.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "render/tiles/row_file.h"
#include "render/tiles/sum_file.h"

namespace defocus::engine {

namespace {

struct MergeArguments {
    std::vector<std::filesystem::path> parts;
    std::vector<std::filesystem::path> outputs = {"out.exr"};
    ToneMap toneMap = Request{}.toneMap;
    std::optional<double> exposure;  // EV; nullopt: exposure in the metadata of the parts
};

// Returns the exposure (EV) stored in the metadata; 0 if there is none.
double ownExposure(const Metadata& metadata) {
    const double* value = attributeOf<double>(metadata, "defocus:exposure");
    return value != nullptr ? *value : 0;
}

void mergeTiles(const MergeArguments& arguments, const GlobalOptions& global) {
    const std::vector<RowFile> tiles = completeRows(arguments.parts);
    Metadata metadata = tiles.front().header.metadata;
    metadata.try_emplace("capDate", std::string());  // no date; otherwise, OpenImageIO would insert the current time
    std::vector<JoinedOutput> outputs;
    for (const std::filesystem::path& path : arguments.outputs) {
        if (isStandardOutput(path))
            throw UsageError("merged tiles cannot go to standard output; give a file name with -o");
        outputs.push_back({path, {arguments.toneMap, arguments.exposure.value_or(ownExposure(metadata))}});
    }
    joinRows(tiles, outputs, metadata);
    if (!global.quiet)
        printMessage("{}: {}x{}, {} tiles\n", shownOutputs(arguments.outputs), tiles.front().header.width,
                     tiles.front().header.height, tiles.size());
}

void runMerge(const MergeArguments& arguments, const GlobalOptions& global) {
    checkImageOutputs(arguments.outputs, {}, arguments.parts);
    if (isRowFile(arguments.parts.front())) return mergeTiles(arguments, global);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const MergedFrame merged = mergeParts(arguments.parts);
    const WriteOptions write{arguments.toneMap, arguments.exposure.value_or(ownExposure(merged.metadata))};
    for (const std::filesystem::path& path : arguments.outputs) writeOutput(path, merged.image, merged.metadata, write);
    if (!global.quiet)
        printMessage("{}: {}x{}, {} parts\n", shownOutputs(arguments.outputs), merged.image.width, merged.image.height,
                     arguments.parts.size());
}

}  // namespace

void addMergeCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<MergeArguments>();
    CLI::App* command = program.add_subcommand(
        "merge",
        "Merge the parts of a frame, written by render or capture with --sample-range, or by render with "
        "--tile");
    command->add_option("PART", arguments->parts, "Parts of one frame, in any order")->required()->type_name("FILE…");
    addImageOutputs(*command, arguments->outputs);
    addNumber(*command, "--exposure", arguments->exposure, {-60, 60}, "EV",
              "Exposure in EV for PNG and JPEG. Default: the exposure of the parts, else 0");
    addChoice<ToneMap>(
        *command, "--tonemap", arguments->toneMap,
        {{"none", ToneMap::none}, {"aces", ToneMap::aces}, {"agx", ToneMap::agx}, {"neutral", ToneMap::neutral}},
        "Tone curve of PNG and JPEG");
    command->footer(
        "The result is bit-identical to a single run on the same kind of machine.\n\n"
        "Example:\n"
        "  defocus render scene.glb --samples 256 --sample-range 0:128 -o a.exr\n"
        "  defocus render scene.glb --samples 256 --sample-range 128:256 -o b.exr\n"
        "  defocus merge a.exr b.exr -o out.exr\n"
        "  defocus render scene.glb --tile 0/2 -o upper.exr\n"
        "  defocus render scene.glb --tile 1/2 -o lower.exr\n"
        "  defocus merge upper.exr lower.exr -o out.exr");
    command->callback([arguments, &global] { runMerge(*arguments, global); });
}

}  // namespace defocus::engine
