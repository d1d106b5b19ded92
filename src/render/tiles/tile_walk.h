#pragma once
// Draws bands of a frame tile by tile. Stills, videos and the library all use it for frames that don't fit into memory
// in one piece.

#include <functional>
#include <vector>

#include "image/image.h"
#include "render/renderer.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

class TileWalk {
public:
    // Receives the pixels of a finished tile, in the tile's size.
    using Sink = std::function<void(const Tile& tile, Image&& pixels)>;

    // All arguments must outlive this object. `plan` is that of the full frame; the method must draw tiles
    // (Method::drawsTiles).
    TileWalk(Renderer& renderer, const FramePlan& plan, const std::vector<Band>& bands, Sink sink);

    // Draws one wave of the current tile. Returns false once all tiles are finished.
    bool advance();

    // Number of image rows finished, including a fraction for the current tile.
    [[nodiscard]] double rowsDone() const;
    // Summed over all finished tiles.
    [[nodiscard]] const RenderStats& stats() const { return stats_; }
    [[nodiscard]] int tiles() const { return tiles_; }

private:
    Renderer* renderer_;
    const FramePlan* plan_;
    const std::vector<Band>* bands_;
    Sink sink_;
    std::size_t band_ = 0;
    std::size_t tile_ = 0;  // index into the band
    bool drawing_ = false;
    double rowsDone_ = 0;
    RenderStats stats_;
    int tiles_ = 0;
};

// Copies a tile's pixels into `rows`, which holds rows of the full image from `firstRow` on.
void placeTile(Image& rows, int firstRow, const Tile& tile, const Image& pixels);

// Adds the stats `added` of a tile to `sum`, both of one frame: sums times and triangles, keeps the larger peak.
void addTileStats(RenderStats& sum, const RenderStats& added);

}  // namespace defocus::engine
