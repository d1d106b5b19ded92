#pragma once
// Frames that `defocus render` draws in tiles: those that don't fit into memory, and shares of a frame (--tile).

#include <functional>
#include <string>

#include "cli/render.h"
#include "core/progress.h"
#include "frame/prepared_frame.h"
#include "image/image_io.h"
#include "render/methods.h"

namespace defocus {

// Throws UsageError for options that don't go with --tile and --resume, before anything long.
void checkTileOptions(const RenderArguments& arguments, const Method& method);

// The text that says what the frame is made of; equal for parts of one frame.
std::string frameSettings(const RenderArguments& arguments, const PreparedFrame& frame,
                          const std::filesystem::path& shaderFolder);

// Whether the frame is drawn in tiles: its rows are shared, or it doesn't fit into `limit` bytes in one piece. Throws
// Error where it doesn't fit and can't be drawn in tiles either, with the reason. Needs the frame's pyramids, and a
// current GL context where the method does.
bool drawsInTiles(const RenderArguments& arguments, const PreparedFrame& frame, const Method& method,
                  std::uint64_t limit);

struct TiledFrame {
    FramePlan plan;  // of the whole frame
    RenderStats stats;
    int tiles = 0;     // that this run drew
    int rowsKept = 0;  // of the image, from an earlier run
};
using TileMetadata = std::function<Metadata(const FramePlan&, const RenderStats&)>;

// Draws the frame's tiles, each to a file: the share's to the output, else some rows each to a folder beside the first
// output. What an interrupted run has left there is kept if --resume was given. Throws Error, saying what is kept,
// where it is asked to stop.
TiledFrame renderTiles(const RenderArguments& arguments, const PreparedFrame& frame, Renderer& renderer,
                       std::uint64_t limit, const std::string& settings, const TileMetadata& metadata,
                       const Progress& progress);

// Joins those files to the outputs, and removes them.
void joinRenderedTiles(const RenderArguments& arguments, const Metadata& metadata, const WriteOptions& write);

}  // namespace defocus
