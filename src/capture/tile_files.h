#pragma once
// Tiles of a frame in files: rendered one after the other or on several machines, and joined afterwards.
//
// A tile's file is an EXR image of some rows of the frame, over its whole width. Its display window is the whole frame
// and its data window those rows, so that any viewer shows it in its place. All lens samples are in it: joining copies
// pixels and holds a few rows at a time.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image_io.h"
#include "plan/tiles.h"
#include "render/renderer.h"
#include "render/tiling.h"

namespace defocus {

// Part `index` (0 … count − 1) of a frame's rows.
struct TileShare {
    int index = 0;
    int count = 1;
};

// "1/4". Throws Error for anything else.
TileShare parseTileShare(std::string_view text);

// What the files of one frame have in common, and what of it a file holds.
struct TileHeader {
    int width = 0;  // px, of the frame
    int height = 0;
    RowRange rows;
    std::string settings;  // what the frame is made of: that of all its tiles
    std::string share;     // "1/4" where a machine was asked for it; empty: rows as memory allowed
    Metadata metadata;     // of the whole frame
};

struct TileFile {
    std::filesystem::path path;
    TileHeader header;
};

// Whether the file is a tile, by what it says of itself. False for what can't be read.
bool isTileFile(const std::filesystem::path& path);

// Throws Error naming the file.
TileHeader readTileHeader(const std::filesystem::path& path);

// What draws bands, and what they take.
struct TileRun {
    Renderer& renderer;
    const FramePlan& plan;                                 // of the whole frame
    std::function<Metadata(const RenderStats&)> metadata;  // of the files
    std::function<void(double rowsDone)> step = {};
    std::function<bool()> stop = {};
    RenderStats stats = {};  // of all that was drawn, added up
    int tiles = 0;
};

// The rows of a band, over the whole width. `rowsDone`: of the bands before, for `step`.
Image drawnBand(const Band& band, TileRun& run, double rowsDone);

// Draws the bands of a tiling and writes them as one file, with a few rows in memory. `stop` is asked after each band:
// once it says so, nothing is written and the result is false. Throws Error naming the file.
bool writeTile(const std::filesystem::path& path, TileHeader header, const std::vector<Band>& bands, TileRun& run);

// The tiles in the order of their rows. Throws Error for tiles that overlap, are missing or are of other settings,
// naming the files, and the part that is missing.
std::vector<TileFile> completeTiles(const std::vector<std::filesystem::path>& paths);

// Writes the frame that the tiles make up to each output. Throws Error naming the file.
struct TileOutput {
    std::filesystem::path path;
    WriteOptions write;
};
void joinTiles(const std::vector<TileFile>& tiles, const std::vector<TileOutput>& outputs, const Metadata& metadata);

// The rows among `rows` that no file covers, in order; the files must be complete's, but for what is missing.
std::vector<RowRange> missingRows(const std::vector<TileFile>& tiles, int height);

}  // namespace defocus
