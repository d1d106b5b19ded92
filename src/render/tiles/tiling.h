#pragma once
// How a frame is cut so that it fits into memory: K layers at once, and as many rows of sums as then fit.

#include <cstdint>
#include <vector>

#include "plan/visible/tiles.h"

namespace defocus::engine {

// What a frame takes and what there is, bytes.
struct TilingNeeds {
    int width = 1;  // px, of the image
    int height = 1;
    RowRange rows;                   // of the image, which are drawn
    std::uint64_t layerPixel = 12;   // of a layer: colour, depth and what shows it through itself
    std::uint64_t layerMaps = 0;     // of the shadow maps that come with a layer, whatever its size
    std::uint64_t waveBytes = 0;     // the most that layers are given
    std::uint32_t askedWave = 0;     // K that was asked for; 0: as many as waveBytes allow
    std::uint64_t deviceMemory = 0;  // for layers and sums
    std::uint64_t hostMemory = 0;    // for rows on their way to a file
    bool shared = true;              // both are the same memory
    std::uint64_t elsewhere = 0;     // of the same memory, for the scene and the program; 0: not known
    std::uint64_t keptBytes = 0;     // of whole pictures that are kept in main memory meanwhile
    bool mayUseCells = true;         // false: the whole image is one cell, whatever its size
};

// Some rows of the image over its whole width, and the tiles that they consist of, from left to right.
struct Band {
    RowRange rows;
    std::vector<Tile> tiles;
    bool operator==(const Band&) const = default;
};

struct Tiling {
    std::uint32_t wave = 1;   // K
    std::vector<Band> bands;  // from the top
};

// Bytes of a pixel's sums on the device, and of a row's pixel on its way to a file.
inline constexpr std::uint64_t sumPixelBytes = 9 * 16;
inline constexpr std::uint64_t tilePixelBytes = 16;  // as it is read back
inline constexpr std::uint64_t bandPixelBytes = 16;  // the whole width
// Of a picture in one piece: read back, encoded, and written.
inline constexpr std::uint64_t wholePixelBytes = 16 + 16 + 16;

// Whether all of the image fits in one piece, with one layer or more; `rows` aren't looked at.
bool fitsInOnePiece(const TilingNeeds& needs);

// Bands that fit, all of the same height but the last of a row of cells. Throws Error, saying what it takes and how
// much memory would do, where not even bands of a few rows do.
Tiling chosenTiling(const TilingNeeds& needs);

}  // namespace defocus::engine
