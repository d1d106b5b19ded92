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
    RowRange rows;  // rows to draw
    // Bytes per pixel of a layer, the image of one sample: colour, depth, and a copy of both for transmission.
    std::uint64_t layerPixel = 12;
    std::uint64_t layerMaps = 0;     // bytes of the shadow maps of one sample
    std::uint64_t dataPixel = 0;     // GPU bytes per pixel of the sums of data layers; the host needs the same amount
    std::uint64_t waveBytes = 0;     // max total size in bytes of the layers of all samples that are drawn together
    std::uint32_t askedWave = 0;     // requested number of samples drawn together; 0: as many as fit into waveBytes
    std::uint64_t deviceMemory = 0;  // free bytes for layers and accumulation buffers
    std::uint64_t hostMemory = 0;    // free bytes of main memory, for rows that are read back from the GPU and written
    bool shared = true;              // true: device and host memory are the same
    std::uint64_t elsewhere = 0;     // process memory in bytes without layers and accumulation buffers; 0: unknown
    std::uint64_t keptBytes = 0;     // bytes of images kept in main memory while drawing
    // false: the image must not be divided into cells (parts with separate window coordinates, plan/visible/tiles.h).
    bool mayUseCells = true;
};

// Rows of the image over its full width, and the tiles that cover them, from left to right.
struct Band {
    RowRange rows;
    std::vector<Tile> tiles;
    bool operator==(const Band&) const = default;
};

struct Tiling {
    std::uint32_t wave = 1;   // number of samples drawn together, each into its own layer
    std::vector<Band> bands;  // bands from top to bottom
};

// Bytes per pixel of the accumulation buffers (nine RGBA32F textures) in device memory.
inline constexpr std::uint64_t sumPixelBytes = 9 * 16;
inline constexpr std::uint64_t tilePixelBytes = 16;  // bytes per pixel of a tile read back to the host: RGBA floats
inline constexpr std::uint64_t bandPixelBytes = 16;  // bytes per pixel of a band on the host: RGBA floats
// Bytes per pixel on the host for an image without tiles: three copies (read back, encoded and written).
inline constexpr std::uint64_t untiledPixelBytes = 16 + 16 + 16;

// Returns whether the full image fits into memory without tiles if a single layer (image of one sample) is drawn at a
// time. TilingNeeds::rows is ignored.
bool fitsInOnePiece(const TilingNeeds& needs);

// Returns bands that fit into memory. All bands in a row of cells (parts of a large image; see plan/visible/tiles.h)
// have equal height, except that the last one may have fewer rows. Throws Error, with the required memory in its
// message, if not even bands of a few rows fit.
Tiling chosenTiling(const TilingNeeds& needs);

}  // namespace defocus::engine
