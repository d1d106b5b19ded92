#pragma once
// Divides the image into parts, for frames that exceed memory or that several machines share.
//
// A tile is bit-identical to the same pixels of the entire image. Tiles are drawn with the entire image's viewport, so
// window coordinates and their rounding in the rasterizer stay the same. Only the tile's pixels are kept and summed.
// Window coordinates and layers have a maximum size. Images larger than maxCellPixels therefore consist of cells with
// separate window coordinates. Cells depend only on the image's size, so the pixels don't depend on the size of the
// tiles.

#include <vector>

namespace defocus::engine {

struct FramePlan;

// Rectangle in px of the image; row 0 is the top row.
struct PixelRectangle {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    bool operator==(const PixelRectangle&) const = default;
};

struct Tile {
    PixelRectangle area;
    // Part of the image with its own window coordinates, at most maxCellPixels wide and high. Contains `area`, which is
    // drawn in these coordinates.
    PixelRectangle cell;
    bool operator==(const Tile&) const = default;
};

inline constexpr int maxCellPixels = 8192;  // max side of a cell, px; larger images consist of several cells

// Returns the cells of an image, row by row. All cells have the same size, except that the last cell of a row or column
// may be smaller.
std::vector<PixelRectangle> cellsOf(int width, int height);

// Rows [first, end) of the image.
struct RowRange {
    int first = 0;
    int end = 0;
    bool operator==(const RowRange&) const = default;
};

// Returns part `index` (0 … count − 1) of `count` nearly equal parts of the image's rows. `count` is at most `height`.
RowRange rowsOfPart(int height, int index, int count);

// Returns the plan of a tile. Objects that no lens sample sees in the tile are left out, unless the frame has
// transmissive objects. Levels, lens samples and everything else are the same as in the entire frame.
FramePlan tileOf(const FramePlan& plan, const Tile& tile);

}  // namespace defocus::engine
