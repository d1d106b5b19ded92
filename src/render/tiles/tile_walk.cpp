#include "render/tiles/tile_walk.h"

#include <algorithm>
#include <utility>

namespace defocus::engine {

namespace {

// Returns how much each finished tile of the band adds to rowsDone(): the band's rows divided by its number of tiles.
double rowsOfTile(const Band& band) {
    return static_cast<double>(band.rows.end - band.rows.first) / static_cast<double>(band.tiles.size());
}

}  // namespace

TileWalk::TileWalk(Renderer& renderer, const FramePlan& plan, const std::vector<Band>& bands, Sink sink)
    : renderer_(&renderer), plan_(&plan), bands_(&bands), sink_(std::move(sink)) {}

bool TileWalk::advance() {
    if (band_ == bands_->size()) return false;
    const Band& band = (*bands_)[band_];
    const Tile& tile = band.tiles[tile_];
    if (!std::exchange(drawing_, true)) renderer_->start(tileOf(*plan_, tile));
    if (renderer_->advance()) return true;

    // The current tile is complete.
    drawing_ = false;
    addTileStats(stats_, renderer_->stats());
    ++tiles_;
    rowsDone_ += rowsOfTile(band);
    sink_(tile, renderer_->image());
    if (++tile_ == band.tiles.size()) {
        tile_ = 0;
        ++band_;
    }
    return band_ < bands_->size();
}

double TileWalk::rowsDone() const {
    if (!drawing_) return rowsDone_;
    return rowsDone_ + rowsOfTile((*bands_)[band_]) * renderer_->samples() / renderer_->sampleTotal();
}

void placeTile(Image& rows, int firstRow, const Tile& tile, const Image& pixels) {
    for (int y = 0; y < pixels.height; ++y)
        std::copy_n(pixels.at(0, y), pixels.width * pixels.channels,
                    rows.at(tile.area.left, tile.area.top - firstRow + y));
}

void addTileStats(RenderStats& sum, const RenderStats& added) {
    RenderStats both = added;
    both.setupMilliseconds += sum.setupMilliseconds;
    both.renderMilliseconds += sum.renderMilliseconds;
    both.cpuTime += sum.cpuTime;
    both.gpuMilliseconds += sum.gpuMilliseconds;
    both.trianglesDrawn += sum.trianglesDrawn;
    both.trianglesHidden += sum.trianglesHidden;
    both.peakBytes = std::max(sum.peakBytes, added.peakBytes);
    sum = std::move(both);
}

}  // namespace defocus::engine
