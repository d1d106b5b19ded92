#include "capture/tile_files.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "capture/frame_files.h"
#include "core/error.h"
#include "core/parse.h"
#include "image/image_rows.h"
#include "render/tile_walk.h"

namespace defocus {

namespace {

namespace fs = std::filesystem;

constexpr const char* tileAttribute = "defocus:tile";  // "1/4", or "rows"
constexpr const char* byMemory = "rows";
constexpr int rowsAtOnce = 64;  // that are in memory while tiles are joined

const std::string* textOf(const Metadata& metadata, const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
}

TileHeader headerOf(const ImageRowReader& reader, const fs::path& path) {
    TileHeader header;
    header.metadata = reader.metadata();
    const std::string* tile = textOf(header.metadata, tileAttribute);
    const std::string* settings = textOf(header.metadata, settingsAttribute);
    if (tile == nullptr || settings == nullptr)
        fail("{}: not a tile of a frame: it doesn't say '{}'", path.string(),
             tile == nullptr ? tileAttribute : settingsAttribute);
    header.share = *tile == byMemory ? "" : *tile;
    header.settings = *settings;
    const RowPlace place = reader.place();
    header.width = reader.width();
    header.height = place.imageHeight;
    header.rows = {place.firstRow, place.firstRow + reader.height()};
    if (header.rows.first < 0 || header.rows.end > header.height)
        fail("{}: rows {} to {} are no part of a frame of {}", path.string(), header.rows.first, header.rows.end - 1,
             header.height);
    dropFileAttributes(header.metadata);
    header.metadata.erase(tileAttribute);
    return header;
}

std::string rowsText(const RowRange& rows) {
    return rows.end - rows.first == 1 ? fmt::format("row {}", rows.first)
                                      : fmt::format("rows {} to {}", rows.first, rows.end - 1);
}

// The number of parts that the shares of all tiles agree on.
std::optional<int> commonCount(const std::vector<TileFile>& tiles) {
    std::optional<int> count;
    for (const TileFile& tile : tiles) {
        if (tile.header.share.empty()) return {};
        const int own = parseTileShare(tile.header.share).count;
        if (count && *count != own) return {};
        count = own;
    }
    return count;
}

[[noreturn]] void failForMissing(const std::vector<TileFile>& tiles, const RowRange& missing) {
    const int height = tiles.front().header.height;
    if (const std::optional<int> count = commonCount(tiles))
        for (int i = 0; i < *count; ++i)
            if (const RowRange rows = rowsOfPart(height, i, *count);
                rows.first <= missing.first && missing.first < rows.end)
                fail("tile {}/{} of the frame is missing: {} of {} (--tile {}/{})", i, *count, rowsText(rows), height,
                     i, *count);
    fail("{} of the frame's {} are missing", rowsText(missing), height);
}

}  // namespace

TileShare parseTileShare(std::string_view text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    TileShare share;
    try {
        share.index = static_cast<int>(parseWhole(std::string(text.substr(0, slash)), 0, mostPixels - 1));
        share.count =
            static_cast<int>(parseWhole(std::string(text.substr(std::min(slash + 1, text.size()))), 1, mostPixels));
    } catch (const Error&) {
        fail("'{}' is not I/N, such as 0/4: tile I, from 0 to N-1, of N", text);
    }
    if (share.index >= share.count)
        fail("'{}': the tiles of {} are 0 to {} (of a Slurm job: --array=0-{})", text, share.count, share.count - 1,
             share.count - 1);
    return share;
}

bool isTileFile(const fs::path& path) try {
    const Metadata metadata = ImageRowReader(path).metadata();
    return textOf(metadata, tileAttribute) != nullptr;
} catch (const Error&) {
    return false;
}

TileHeader readTileHeader(const fs::path& path) {
    return headerOf(ImageRowReader(path), path);
}

Image drawnBand(const Band& band, TileRun& run, double rowsDone) {
    Image rows;
    const std::vector<Band> one = {band};
    TileWalk walk(run.renderer, run.plan, one, [&](const Tile& tile, Image&& pixels) {
        if (band.tiles.size() == 1) {
            rows = std::move(pixels);
            return;
        }
        if (rows.empty()) rows = Image(run.plan.view.width, pixels.height, pixels.channels);
        placeTile(rows, band.rows.first, tile, pixels);
    });
    while (walk.advance())
        if (run.step) run.step(rowsDone + walk.rowsDone());
    addTileStats(run.stats, walk.stats());
    run.tiles += walk.tiles();
    return rows;
}

bool writeTile(const fs::path& path, TileHeader header, const std::vector<Band>& bands, TileRun& run) {
    std::optional<ImageRowWriter> writer;
    double rowsDone = 0;
    for (const Band& band : bands) {
        const Image rows = drawnBand(band, run, rowsDone);
        if (!writer) {
            Metadata metadata = run.metadata(run.stats);
            metadata.erase("defocus:seconds");  // of one band
            metadata["capDate"] = std::string();
            metadata[settingsAttribute] = header.settings;
            metadata[tileAttribute] = header.share.empty() ? byMemory : header.share;
            writer.emplace(path, header.width, header.rows.end - header.rows.first, rows.channels, metadata,
                           WriteOptions{}, RowPlace{header.rows.first, header.height});
        }
        writer->write(rows);
        rowsDone += rows.height;
        if (run.step) run.step(rowsDone);
        if (run.stop && run.stop() && &band != &bands.back()) return false;
    }
    writer->finish();
    return true;
}

std::vector<RowRange> missingRows(const std::vector<TileFile>& tiles, int height) {
    std::vector<RowRange> missing;
    int next = 0;
    for (const TileFile& tile : tiles) {
        if (tile.header.rows.first > next) missing.push_back({next, tile.header.rows.first});
        next = std::max(next, tile.header.rows.end);
    }
    if (next < height) missing.push_back({next, height});
    return missing;
}

std::vector<TileFile> completeTiles(const std::vector<fs::path>& paths) {
    std::vector<TileFile> tiles;
    for (const fs::path& path : paths) tiles.push_back({path, readTileHeader(path)});
    if (tiles.empty()) fail("there are no tiles to join");
    std::ranges::stable_sort(tiles, {}, [](const TileFile& tile) { return tile.header.rows.first; });
    const TileHeader& first = tiles.front().header;
    for (std::size_t i = 1; i < tiles.size(); ++i) {
        const TileHeader& header = tiles[i].header;
        if (header.settings != first.settings || header.width != first.width || header.height != first.height)
            fail("{} and {} don't belong together: they were rendered with other settings", tiles.front().path.string(),
                 tiles[i].path.string());
        if (header.rows.first < tiles[i - 1].header.rows.end)
            fail("{} and {} overlap: both hold row {}", tiles[i - 1].path.string(), tiles[i].path.string(),
                 header.rows.first);
    }
    const std::vector<RowRange> missing = missingRows(tiles, first.height);
    if (!missing.empty()) failForMissing(tiles, missing.front());
    return tiles;
}

void joinTiles(const std::vector<TileFile>& tiles, const std::vector<TileOutput>& outputs, const Metadata& metadata) {
    const TileHeader& header = tiles.front().header;
    std::vector<ImageRowWriter> writers;
    int channels = 0;
    for (const TileFile& tile : tiles) {
        ImageRowReader reader(tile.path);
        if (writers.empty()) {
            channels = reader.channels();
            for (const TileOutput& output : outputs)
                writers.emplace_back(output.path, header.width, header.height, channels, metadata, output.write);
        }
        if (reader.channels() != channels)
            fail("{} and {} differ in their channels", tiles.front().path.string(), tile.path.string());
        for (int first = 0; first < reader.height(); first += rowsAtOnce) {
            const Image rows = reader.read(first, std::min(rowsAtOnce, reader.height() - first));
            for (ImageRowWriter& writer : writers) writer.write(rows);
        }
    }
    for (ImageRowWriter& writer : writers) writer.finish();
}

}  // namespace defocus
