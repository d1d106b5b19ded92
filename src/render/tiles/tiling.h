#pragma once
// Divides a frame so that it fits into memory: K layers at once, and as many rows of sums as then fit.

#include <cstdint>
#include <vector>

#include "plan/visible/tiles.h"

namespace defocus::engine {

// Needs of a frame and available memory, in bytes.
struct TilingNeeds {
    int width = 1;  // size of the image, px
    int height = 1;
    RowRange rows;                   // rows of the image to draw
    std::uint64_t layerPixel = 12;   // bytes of a layer per pixel: colour, depth and backdrop
    std::uint64_t layerMaps = 0;     // shadow maps per layer, for any layer size
    std::uint64_t waveBytes = 0;     // limit for the layers
    std::uint32_t askedWave = 0;     // requested K; 0: as many as fit into waveBytes
    std::uint64_t deviceMemory = 0;  // available for layers and sums
    std::uint64_t hostMemory = 0;    // available for rows on their way to a file
    bool shared = true;              // device and host memory are the same
    std::uint64_t elsewhere = 0;     // of shared memory, used by scene and program; 0: unknown
    std::uint64_t keptBytes = 0;     // images kept in main memory meanwhile
    bool mayUseCells = true;         // false: the full image is one cell
};

// Some rows of the image over its full width, and the tiles that cover them, from left to right.
struct Band {
    RowRange rows;
    std::vector<Tile> tiles;
    bool operator==(const Band&) const = default;
};

struct Tiling {
    std::uint32_t wave = 1;   // K
    std::vector<Band> bands;  // from top to bottom
};

// Bytes of a pixel: of the sums on the device, and of a row on its way to a file.
inline constexpr std::uint64_t sumPixelBytes = 9 * 16;
inline constexpr std::uint64_t tilePixelBytes = 16;  // as read back
inline constexpr std::uint64_t bandPixelBytes = 16;  // over the full width of the image
// Bytes per pixel of an image in one piece: read back, encoded, and written.
inline constexpr std::uint64_t wholePixelBytes = 16 + 16 + 16;

// Returns whether the full image fits in one piece, with at least one layer; ignores `rows`.
bool fitsInOnePiece(const TilingNeeds& needs);

// Returns bands that fit into memory. They have equal heights, except for the last band in a row of cells. Throws
// Error, with the needed memory, if not even bands of a few rows fit.
Tiling chosenTiling(const TilingNeeds& needs);

}  // namespace defocus::engine
