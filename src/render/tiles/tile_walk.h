#pragma once
// Draws a frame that does not fit into memory, band by band and tile by tile.

#include <functional>
#include <vector>

#include "image/image.h"
#include "render/renderer.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

class TileWalk {
public:
    // Receives the pixels of a complete tile; the image `pixels` has the tile's size.
    using Sink = std::function<void(const Tile& tile, Image&& pixels)>;

    // All arguments must outlive this object. `plan` is the plan of the full frame. The renderer's method must draw
    // tiles (Method::drawsTiles).
    TileWalk(Renderer& renderer, const FramePlan& plan, const std::vector<Band>& bands, Sink sink);

    // Draws one batch (wave) of samples of the current tile. Returns false once all tiles are complete.
    bool advance();

    // Returns the number of complete image rows, plus a fraction for complete tiles and samples of the current band.
    [[nodiscard]] double rowsDone() const;
    // Returns the sum of the statistics of all complete tiles.
    [[nodiscard]] const RenderStats& stats() const { return stats_; }
    [[nodiscard]] int tiles() const { return tiles_; }

private:
    Renderer* renderer_;
    const FramePlan* plan_;
    const std::vector<Band>* bands_;
    Sink sink_;
    std::size_t band_ = 0;
    std::size_t tile_ = 0;  // index into Band::tiles
    bool drawing_ = false;
    double rowsDone_ = 0;
    RenderStats stats_;
    int tiles_ = 0;
};

// Copies a tile's pixels into `rows`, whose first row is row `firstRow` of the full image.
void placeTile(Image& rows, int firstRow, const Tile& tile, const Image& pixels);

// Adds the statistics of a tile to those of its frame: times and triangles are summed; of the peak memory, the larger
// value is kept.
void addTileStats(RenderStats& sum, const RenderStats& added);

}  // namespace defocus::engine
