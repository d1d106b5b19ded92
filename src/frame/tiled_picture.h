#pragma once
// A picture of its own of a frame that is drawn in tiles: what the library hands out.

#include <cstdint>
#include <utility>
#include <vector>

#include "render/tile_walk.h"

namespace defocus {

// The frame, from the top, in an image that is kept in main memory.
struct TiledPicture {
    TiledPicture(Renderer& renderer, FramePlan frame, std::vector<Band> rows)
        : plan(std::move(frame)),
          bands(std::move(rows)),
          image(plan.view.width, plan.view.height, 4),
          walk(renderer, plan, bands, [this](const Tile& tile, Image&& pixels) { placeTile(image, 0, tile, pixels); }) {
    }
    TiledPicture(const TiledPicture&) = delete;
    TiledPicture& operator=(const TiledPicture&) = delete;

    [[nodiscard]] std::uint32_t sampleTotal() const { return static_cast<std::uint32_t>(plan.samples.size()); }
    // Of the picture as a whole. Thirds of rows are added up with rounding, which mustn't cost the last sample.
    [[nodiscard]] std::uint32_t samples() const {
        return static_cast<std::uint32_t>(sampleTotal() * walk.rowsDone() / plan.view.height + 1e-6);
    }
    [[nodiscard]] RenderStats stats() const {
        RenderStats stats = walk.stats();
        stats.samples = samples();
        return stats;
    }

    FramePlan plan;
    std::vector<Band> bands;
    Image image;  // what isn't drawn yet is nothing: black, of no coverage
    TileWalk walk;
};

}  // namespace defocus
