#include "render/tiles/row_file.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

constexpr const char* tileAttribute = "defocus:tile";  // value: "1/4" or "rows"
constexpr const char* byMemory = "rows";
constexpr int rowsAtOnce = 64;  // max rows in memory while files are joined

RowFileHeader headerOf(const ImageRowReader& reader, const fs::path& path) {
    RowFileHeader header;
    header.metadata = reader.metadata();
    const std::string* tile = attributeOf<std::string>(header.metadata, tileAttribute);
    const std::string* settings = attributeOf<std::string>(header.metadata, settingsAttribute);
    if (tile == nullptr || settings == nullptr)
        fail("{} is not a tile of a frame: the attribute '{}' is missing", path.string(),
             tile == nullptr ? tileAttribute : settingsAttribute);
    header.share = *tile == byMemory ? "" : *tile;
    header.settings = *settings;
    const RowPlace place = reader.place();
    header.width = reader.width();
    header.height = place.imageHeight;
    header.rows = {place.firstRow, place.firstRow + reader.height()};
    if (header.rows.first < 0 || header.rows.end > header.height)
        fail("{}: rows {} to {} are outside a frame of {} rows", path.string(), header.rows.first, header.rows.end - 1,
             header.height);
    dropFileAttributes(header.metadata);
    header.metadata.erase(tileAttribute);
    return header;
}

std::string rowsText(const RowRange& rows) {
    return rows.end - rows.first == 1 ? fmt::format("row {}", rows.first)
                                      : fmt::format("rows {} to {}", rows.first, rows.end - 1);
}

// Returns the number of parts into which the rows are divided, if it is the same in all files; otherwise nullopt.
std::optional<int> commonCount(const std::vector<RowFile>& tiles) {
    std::optional<int> count;
    for (const RowFile& tile : tiles) {
        if (tile.header.share.empty()) return {};
        const int own = parseTileShare(tile.header.share).count;
        if (count && *count != own) return {};
        count = own;
    }
    return count;
}

[[noreturn]] void failForMissing(const std::vector<RowFile>& tiles, const RowRange& missing) {
    const int height = tiles.front().header.height;
    if (const std::optional<int> count = commonCount(tiles))
        for (int i = 0; i < *count; ++i)
            if (const RowRange rows = rowsOfPart(height, i, *count);
                rows.first <= missing.first && missing.first < rows.end)
                fail("a tile of the frame is missing: {} of {}; render it with --tile {}/{}", rowsText(rows), height, i,
                     *count);
    fail("{} of the frame's {} rows are missing", rowsText(missing), height);
}

}  // namespace

bool isRowFile(const fs::path& path) try {
    const Metadata metadata = ImageRowReader(path).metadata();
    return attributeOf<std::string>(metadata, tileAttribute) != nullptr;
} catch (const Error&) {
    return false;
}

RowFileHeader readRowHeader(const fs::path& path) {
    return headerOf(ImageRowReader(path), path);
}

ImageRowWriter rowFileWriter(const fs::path& path, const RowFileHeader& header, int channels) {
    Metadata metadata = header.metadata;
    metadata.erase("defocus:seconds");    // the render time differs between runs
    metadata["capDate"] = std::string();  // no date; otherwise, OpenImageIO would write the current time
    metadata[settingsAttribute] = header.settings;
    metadata[tileAttribute] = header.share.empty() ? byMemory : header.share;
    return {path,
            header.width,
            header.rows.end - header.rows.first,
            channels,
            metadata,
            WriteOptions{},
            RowPlace{header.rows.first, header.height},
            header.share.empty() ? NamedBy::program : NamedBy::user};
}

std::vector<RowRange> missingRows(const std::vector<RowFile>& tiles, int height) {
    std::vector<RowRange> missing;
    int next = 0;
    for (const RowFile& tile : tiles) {
        if (tile.header.rows.first > next) missing.push_back({next, tile.header.rows.first});
        next = std::max(next, tile.header.rows.end);
    }
    if (next < height) missing.push_back({next, height});
    return missing;
}

std::vector<RowFile> completeRows(const std::vector<fs::path>& paths) {
    std::vector<RowFile> tiles;
    for (const fs::path& path : paths) tiles.push_back({path, readRowHeader(path)});
    if (tiles.empty()) fail("no tiles given; name the files written by 'defocus render --tile'");
    std::ranges::stable_sort(tiles, {}, [](const RowFile& tile) { return tile.header.rows.first; });
    const RowFileHeader& first = tiles.front().header;
    for (std::size_t i = 1; i < tiles.size(); ++i) {
        const RowFileHeader& header = tiles[i].header;
        if (header.settings != first.settings || header.width != first.width || header.height != first.height)
            fail("{} and {} belong to different frames: {}", tiles.front().path.string(), tiles[i].path.string(),
                 settingsDifference(first.metadata, header.metadata));
        if (header.rows.first < tiles[i - 1].header.rows.end)
            fail("{} and {} overlap: both hold row {}", tiles[i - 1].path.string(), tiles[i].path.string(),
                 header.rows.first);
    }
    const std::vector<RowRange> missing = missingRows(tiles, first.height);
    if (!missing.empty()) failForMissing(tiles, missing.front());
    return tiles;
}

void joinRows(const std::vector<RowFile>& tiles, const std::vector<JoinedOutput>& outputs, const Metadata& metadata) {
    const RowFileHeader& header = tiles.front().header;
    std::vector<ImageRowWriter> writers;
    int channels = 0;
    for (const RowFile& tile : tiles) {
        ImageRowReader reader(tile.path);
        if (writers.empty()) {
            channels = reader.channels();
            for (const JoinedOutput& output : outputs)
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

}  // namespace defocus::engine
