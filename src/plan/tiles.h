#pragma once
// Which tiles of the image the layers of a block (rates.h) can show something in, from the boxes of its objects.

#include <cstdint>
#include <vector>

#include "plan/rates.h"

namespace defocus {

inline constexpr int tileSide = 16;  // px

// The kinds of layers that show something in a tile: bit 0 for those of the image's own pixels, bit i + 1 for those of
// largerPixelRates[i].
using TileLayers = std::uint8_t;
inline constexpr TileLayers tileKinds = 8;

struct Tiles {
    int columns = 0;
    int rows = 0;
    std::vector<TileLayers> layers;  // row by row from the bottom left
    [[nodiscard]] TileLayers at(int column, int row) const {
        return layers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
    // The share of the tiles that several kinds of layers show something in.
    [[nodiscard]] double mixedShare() const;
};

// Returns the tiles of a block. They are conservative: whatever the lens sample, the pixel offset and the
// interpolation, no kind of layer shows anything outside its tiles.
Tiles blockTiles(const RatedBlock& block);

// Returns the tiles with these layers as areas that don't overlap, cut off at the image's border.
std::vector<PixelArea> tileAreas(const Tiles& tiles, TileLayers layers, const View& view);

}  // namespace defocus
