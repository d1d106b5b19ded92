#pragma once
// Divides a frame into tiles that fit into memory: chooses how many samples are drawn together and how many rows each
// band of tiles has.

#include <cstdint>
#include <vector>

#include "plan/visible/tiles.h"

namespace defocus::engine {

// Memory needs of a frame and available memory.
struct TilingNeeds {
    int width = 1;  // size of the image in px
    int height = 1;
    RowRange rows;                   // rows to draw
    std::uint64_t layerPixel = 12;   // bytes per pixel of a layer: colour, depth and copy for transmission
    std::uint64_t layerMaps = 0;     // bytes of shadow maps per layer
    std::uint64_t dataPixel = 0;     // bytes per pixel of the sums of data layers; the host needs as many again
    std::uint64_t waveBytes = 0;     // max bytes of all layers
    std::uint32_t askedWave = 0;     // requested number of samples drawn together; 0: as many as fit into waveBytes
    std::uint64_t deviceMemory = 0;  // free bytes for layers and accumulation buffers
    std::uint64_t hostMemory = 0;    // free bytes for rows that are read back and written
    bool shared = true;              // true: device and host memory are the same
    std::uint64_t elsewhere = 0;     // bytes of the process without layers and accumulation buffers; 0: unknown
    std::uint64_t keptBytes = 0;     // bytes of images kept in main memory while drawing
    bool mayUseCells = true;         // false: the image must not be divided into cells (plan/visible/tiles.h)
};

// Rows of the image over its full width, and the tiles that cover them, from left to right.
struct Band {
    RowRange rows;
    std::vector<Tile> tiles;
    bool operator==(const Band&) const = default;
};

struct Tiling {
    std::uint32_t wave = 1;   // number of samples drawn together, each into its layer
    std::vector<Band> bands;  // bands from top to bottom
};

// Bytes per pixel of the accumulation buffers, in device memory.
inline constexpr std::uint64_t sumPixelBytes = 9 * 16;
inline constexpr std::uint64_t tilePixelBytes = 16;  // bytes per pixel of a tile read back to the host: RGBA floats
inline constexpr std::uint64_t bandPixelBytes = 16;  // bytes per pixel of a band on the host: RGBA floats
// Bytes per pixel on the host for an image without tiles: three copies (read back, encoded and written).
inline constexpr std::uint64_t wholePixelBytes = 16 + 16 + 16;

// Returns whether the full image fits into memory without tiles, with at least one layer; ignores `rows`.
bool fitsInOnePiece(const TilingNeeds& needs);

// Returns bands that fit into memory, of equal height except for the last band in a row of cells. Throws Error, with
// the required memory in its message, if even bands of a few rows do not fit.
Tiling chosenTiling(const TilingNeeds& needs);

}  // namespace defocus::engine
