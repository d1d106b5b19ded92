#pragma once
// Parts of the image, for frames that don't fit into memory and for frames that several machines share.
//
// A tile has the same bits as the same pixels of the whole image: it is drawn with the whole image's viewport, so that
// all window coordinates, and what rasterisers round of them, stay. Only its pixels are kept and summed. Since window
// coordinates and layers are bounded, an image wider or higher than mostCellPixels consists of cells, each with window
// coordinates of its own. Cells follow from the image's size alone, so that tiles of any size have the same bits.

#include <vector>

namespace defocus::engine {

struct FramePlan;

// px of the image; row 0 is the top row.
struct PixelRectangle {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    bool operator==(const PixelRectangle&) const = default;
};

struct Tile {
    PixelRectangle area;
    PixelRectangle cell;  // whose window coordinates the area is drawn with; it contains the area
    bool operator==(const Tile&) const = default;
};

inline constexpr int maxCellPixels = 8192;  // of a cell's width and of its height

// The cells of an image, row by row. All have the same size, but the last of a row or column may be smaller.
std::vector<PixelRectangle> cellsOf(int width, int height);

// Rows [first, end) of the image.
struct RowRange {
    int first = 0;
    int end = 0;
    bool operator==(const RowRange&) const = default;
};

// Part `index` (0 … count − 1) of `count` parts of the rows, as equal as whole rows can be. `count` is at most
// `height`.
RowRange rowsOfPart(int height, int index, int count);

// The plan of the tile alone: objects that no lens sample shows there are left out, unless something may show them
// through itself. Levels, lens samples and all else stay those of the whole frame.
FramePlan tileOf(const FramePlan& plan, const Tile& tile);

}  // namespace defocus::engine
