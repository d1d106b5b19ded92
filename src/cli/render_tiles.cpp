#include "cli/render_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "capture/frame_files.h"
#include "capture/settings_hash.h"
#include "cli/image_output.h"
#include "cli/stop_signal.h"
#include "core/error.h"
#include "core/file.h"
#include "frame/tiled_frame.h"

namespace defocus {

namespace {

namespace fs = std::filesystem;

RowRange wantedRows(const RenderArguments& arguments, int height) {
    if (!arguments.tile) return {0, height};
    if (arguments.tile->count > height)
        fail("--tile {}/{}: the image has {} rows", arguments.tile->index, arguments.tile->count, height);
    return rowsOfPart(height, arguments.tile->index, arguments.tile->count);
}

// out.exr → out.tiles
fs::path tilesFolder(const RenderArguments& arguments) {
    fs::path folder = arguments.outputs.front();
    folder.replace_extension("tiles");
    return folder;
}

fs::path rowsPath(const fs::path& folder, const RowRange& rows) {
    return folder / fmt::format("rows-{:05}-{:05}.exr", rows.first, rows.end);
}

// What lies in the folder of earlier runs: tiles of these settings, in order and without overlap, and all that there
// are.
struct FoundTiles {
    std::vector<TileFile> fitting;
    std::vector<fs::path> all;
};

FoundTiles tilesIn(const fs::path& folder, const TileHeader& wanted) {
    FoundTiles found;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        // Of a process that was killed while it wrote.
        if (entry.path().filename().string().starts_with(".rows-")) removeAbandoned(entry.path());
        if (!entry.path().filename().string().starts_with("rows-") || !isTileFile(entry.path())) continue;
        found.all.push_back(entry.path());
        const TileHeader header = readTileHeader(entry.path());
        if (header.settings == wanted.settings && header.width == wanted.width && header.height == wanted.height)
            found.fitting.push_back({entry.path(), header});
    }
    std::ranges::sort(found.fitting, {}, [](const TileFile& tile) { return tile.header.rows.first; });
    std::erase_if(found.fitting, [end = 0](const TileFile& tile) mutable {
        const bool overlaps = tile.header.rows.first < end;
        if (!overlaps) end = tile.header.rows.end;
        return overlaps;
    });
    return found;
}

// Bands of `rows`, as memory allows.
std::vector<Band> bandsOf(TilingNeeds needs, const RowRange& rows) {
    needs.rows = rows;
    return chosenTiling(needs).bands;
}

}  // namespace

void checkTileOptions(const RenderArguments& arguments, const Method& method) {
    const std::string option = arguments.tile ? "--tile" : "--resume";
    if (!arguments.tile && !arguments.resume) return;
    if (!method.drawsTiles)
        throw UsageError(fmt::format("{}: method '{}' needs the whole image at once; 'accumulation' draws tiles",
                                     option, method.name));
    if (arguments.sampleRange)
        throw UsageError(option + " and --sample-range don't go together: share one or the other");
    if (arguments.request.stop.given())
        throw UsageError(option + " needs a number of samples, which --target-error and --time-limit leave open");
    if (arguments.aovs.any()) throw UsageError(option + " and --aov don't go together: it shows the whole image");
    if (arguments.tile && (arguments.outputs.size() != 1 || arguments.outputs.front().extension() != ".exr"))
        throw UsageError("--tile writes to one EXR file, such as -o tile.exr");
    for (const fs::path& output : arguments.outputs)
        if (isStandardOutput(output)) throw UsageError(option + " writes to files alone");
}

std::string frameSettings(const RenderArguments& arguments, const PreparedFrame& frame, const fs::path& shaderFolder) {
    SequenceFrame single;
    single.time = arguments.request.time;
    single.pose = frame.world.pose;
    single.shutter = frame.world.shutter;
    single.lights = frame.world.lights;
    single.view = frame.view;
    single.settings = frame.settings;
    return settingsHash(filmSettings(frame, arguments.request, shaderFolder), single);
}

bool drawsInTiles(const RenderArguments& arguments, const PreparedFrame& frame, const Method& method,
                  std::uint64_t limit) {
    if (arguments.tile) return true;
    const FramePlan plan = planFrame(frame.world, frame.view, frame.settings);
    if (!mustDrawInTiles(frame.world, plan, arguments.request, method, limit)) {
        // There may be more memory now than there was for the run that is resumed.
        if (arguments.resume && !fs::is_directory(tilesFolder(arguments)))
            throw UsageError("--resume goes on with tiles, and this frame fits into memory in one piece");
        if (!arguments.resume) return false;
    }
    const auto refuse = [&](const char* reason) { refuseTiles(plan, limit, reason); };
    if (arguments.sampleRange) refuse("--sample-range keeps sums of the whole image; --tile shares its rows instead");
    if (arguments.aovs.any()) refuse("--aov shows the whole image");
    if (std::ranges::any_of(arguments.outputs, isStandardOutput)) refuse("tiles are joined to files alone");
    return true;
}

TiledFrame renderTiles(const RenderArguments& arguments, const PreparedFrame& frame, Renderer& renderer,
                       std::uint64_t limit, const std::string& settings, const TileMetadata& metadata,
                       const Progress& progress) {
    TiledFrame tiled{.plan = planOfTiles(frame.world, frame.view, runSettings(frame, arguments.request)), .stats = {}};
    const FramePlan& plan = tiled.plan;
    TileHeader header{plan.view.width, plan.view.height, wantedRows(arguments, plan.view.height), settings, "", {}};
    if (arguments.tile) header.share = fmt::format("{}/{}", arguments.tile->index, arguments.tile->count);

    // What is there already.
    const fs::path folder = tilesFolder(arguments);
    std::vector<RowRange> missing = {header.rows};
    if (!arguments.tile) {
        const FoundTiles found = tilesIn(folder, header);
        std::vector<fs::path> kept;
        if (arguments.resume) {
            missing = missingRows(found.fitting, plan.view.height);
            for (const TileFile& tile : found.fitting) kept.push_back(tile.path);
        }
        for (const fs::path& path : found.all)
            if (std::ranges::find(kept, path) == kept.end()) fs::remove(path);
    } else if (arguments.resume && isTileFile(arguments.outputs.front())) {
        const TileHeader before = readTileHeader(arguments.outputs.front());
        if (before.settings == settings && before.rows == header.rows && before.height == header.height)
            missing.clear();
    }
    double rowsDone = plan.view.height, total = rowsDone;
    if (arguments.tile) rowsDone = total = header.rows.end - header.rows.first;
    for (const RowRange& rows : missing) rowsDone -= rows.end - rows.first;
    tiled.rowsKept = static_cast<int>(rowsDone);

    // The rest, from the top.
    TileRun run{.renderer = renderer,
                .plan = plan,
                .metadata = [&](const RenderStats& stats) { return metadata(plan, stats); },
                .stop = stopAsked};
    run.step = [&](double rows) {
        report(progress, "rows", static_cast<std::uint64_t>(1000 * (rowsDone + rows)),
               static_cast<std::uint64_t>(1000 * total));
    };
    stopWhenAsked();
    const auto stopped = [&] {
        if (arguments.tile) fail("stopped: nothing of tile {} is kept", header.share);
        fail("stopped: {:.0f} of {} rows are kept in {}; the same command with --resume goes on", rowsDone,
             plan.view.height, folder.string());
    };
    run.step(0);
    if (!missing.empty()) {
        const TilingNeeds needs = measuredNeeds(frame.world, plan, arguments.request, renderer, limit);
        for (const RowRange& rows : missing) {
            const std::vector<Band> bands = bandsOf(needs, rows);
            renderer.setWave(chosenTiling(needs).wave);
            if (arguments.tile) {
                if (!writeTile(arguments.outputs.front(), header, bands, run)) stopped();
                continue;
            }
            fs::create_directories(folder);
            for (const Band& band : bands) {
                if (stopAsked()) stopped();
                header.rows = band.rows;
                writeTile(rowsPath(folder, band.rows), header, {band}, run);
                rowsDone += band.rows.end - band.rows.first;
            }
        }
    }
    tiled.stats = run.stats;
    tiled.tiles = run.tiles;
    if (missing.empty()) tiled.stats.samples = static_cast<std::uint32_t>(plan.samples.size());
    return tiled;
}

void joinRenderedTiles(const RenderArguments& arguments, const Metadata& metadata, const WriteOptions& write) {
    if (arguments.tile) return;
    const fs::path folder = tilesFolder(arguments);
    std::vector<fs::path> paths;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("rows-")) paths.push_back(entry.path());
    std::vector<TileOutput> outputs;
    for (const fs::path& path : arguments.outputs) outputs.push_back({path, write});
    joinTiles(completeTiles(paths), outputs, metadata);
    for (const fs::path& path : paths) fs::remove(path);
    std::error_code notEmpty;
    fs::remove(folder, notEmpty);
}

}  // namespace defocus
