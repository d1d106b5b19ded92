#pragma once
// Draws bands of a frame tile by tile: the one way in which stills, films and the library draw what doesn't fit into
// memory in one piece.

#include <functional>
#include <vector>

#include "image/image.h"
#include "render/renderer.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

class TileWalk {
public:
    // Takes the pixels of a tile that is done, of the tile's size.
    using Sink = std::function<void(const Tile& tile, Image&& pixels)>;

    // All must outlive it. `plan` is that of the whole frame; the method must draw tiles (Method::drawsTiles).
    TileWalk(Renderer& renderer, const FramePlan& plan, const std::vector<Band>& bands, Sink sink);

    // Draws one wave of the tile that is in work; false once all tiles are done.
    bool advance();

    // Rows of the image that are done, those of the tile in work in part.
    [[nodiscard]] double rowsDone() const;
    // Of all tiles that are done, added up.
    [[nodiscard]] const RenderStats& stats() const { return stats_; }
    [[nodiscard]] int tiles() const { return tiles_; }

private:
    Renderer* renderer_;
    const FramePlan* plan_;
    const std::vector<Band>* bands_;
    Sink sink_;
    std::size_t band_ = 0;
    std::size_t tile_ = 0;  // of the band
    bool drawing_ = false;
    double rowsDone_ = 0;
    RenderStats stats_;
    int tiles_ = 0;
};

// Copies a tile's pixels to their place among rows of the whole image, of which `rows` has those from `firstRow` on.
void placeTile(Image& rows, int firstRow, const Tile& tile, const Image& pixels);

// `added` after `sum`, of one frame: times, triangles and the peak of both.
void addTileStats(RenderStats& sum, const RenderStats& added);

}  // namespace defocus::engine
