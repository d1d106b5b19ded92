#include "plan/tiles.h"

#include <algorithm>
#include <bit>

namespace defocus {

namespace {

void mark(const FramePlan& plan, TileLayers kind, Tiles& tiles) {
    for (const ObjectPlan& object : plan.objects) {
        const PixelArea area = seenArea(object, plan);
        if (area.pixels() <= 0) continue;
        for (int row = area.bottom / tileSide; row <= (area.top - 1) / tileSide; ++row)
            for (int column = area.left / tileSide; column <= (area.right - 1) / tileSide; ++column)
                tiles.layers[static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles.columns) +
                             static_cast<std::size_t>(column)] |= kind;
    }
}

}  // namespace

double Tiles::mixedShare() const {
    const auto mixed = std::ranges::count_if(layers, [](TileLayers kinds) { return std::popcount(kinds) > 1; });
    return static_cast<double>(mixed) / static_cast<double>(layers.size());
}

Tiles blockTiles(const RatedBlock& block) {
    const View& view = block.samples.view;
    Tiles tiles{(view.width + tileSide - 1) / tileSide, (view.height + tileSide - 1) / tileSide, {}};
    tiles.layers.resize(static_cast<std::size_t>(tiles.columns) * static_cast<std::size_t>(tiles.rows));
    mark(block.samples, 1, tiles);
    mark(block.groups, 1, tiles);
    for (std::size_t i = 0; i < block.larger.size(); ++i)
        mark(block.larger[i], static_cast<TileLayers>(2u << i), tiles);
    return tiles;
}

std::vector<PixelArea> tileAreas(const Tiles& tiles, TileLayers layers, const View& view) {
    std::vector<PixelArea> areas;
    for (int row = 0; row < tiles.rows; ++row)
        for (int column = 0; column < tiles.columns; ++column) {
            if (tiles.at(column, row) != layers) continue;
            const int first = column;
            while (column + 1 < tiles.columns && tiles.at(column + 1, row) == layers) ++column;
            areas.push_back({first * tileSide, row * tileSide, std::min((column + 1) * tileSide, view.width),
                             std::min((row + 1) * tileSide, view.height)});
        }
    return areas;
}

}  // namespace defocus
